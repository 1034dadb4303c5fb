/* SPDX-License-Identifier: MIT
 *
 * pins - looks up what the last scan has left; see pins.h. It evaluates nothing.
 */
#include "ladder/pins.h"

#include "engine/base/name.h"
#include "engine/model/st.h"

#include <stdio.h>
#include <string.h>

/* A name as its POU, or its instance, means it. */
static struct location find(const struct pins *pins, const char *name)
{
	const char *before[2] = { pins->instance, project_text(pins->project, pins->project->pou[pins->pou].name) };
	const struct image *image = &pins->resource->image;
	struct location at = { .type = IEC_NONE };
	char text[3 * LIMIT_NAME + 16];

	for (int i = 0; i < 2 && at.type == IEC_NONE && *name != '%'; i++) {
		const int len = before[i] ? snprintf(text, sizeof(text), "%s.%s", before[i], name) : 0;

		if (len > 0 && (size_t)len < sizeof(text))
			at = image_find(image, text, (size_t)len);
	}
	return at.type != IEC_NONE ? at : image_find(image, name, strlen(name));
}

/* A wire is a variable of the POU. */
static struct location find_wire(const struct pins *pins, int network, const char *name, bool before)
{
	char text[2 * LIMIT_NAME + 16];

	snprintf(text, sizeof(text), "%.*s.%c%d", 2 * LIMIT_NAME, name, before ? 'P' : 'N', network + 1);
	return find(pins, text);
}

/* ---- results that no variable has ---- */

static int unit_of(const struct pins *pins)
{
	const struct program *program = pins->resource->image.program;
	const char *name = project_text(pins->project, pins->project->pou[pins->pou].name);

	for (uint32_t i = 0; i < program->entry_count; i++)
		if (name_equal(program->string + program->entry[i].name, name))
			return (int)i;
	return -1;
}

/* A place in the body of a block is copied for each of its instances. */
static uint32_t place_of(const struct pins *pins, uint32_t offset)
{
	const struct program *program = pins->resource->image.program;

	for (uint32_t i = 0; pins->instance && i < program->watched_count; i++) {
		const struct code_watched *watched = &program->watched[i];

		if (strcmp(program->string + watched->name, pins->instance) == 0 && offset - watched->from < watched->size)
			return watched->to + (offset - watched->from);
	}
	return offset;
}

/* What code_listed() counts. */
static bool is_listed(const struct il_line *line)
{
	return line->kind == IL_OP || line->kind == IL_FN || line->kind == IL_CLOSE || line->kind == IL_LABEL ||
	       line->kind == IL_CALL;
}

static const struct code_power *find_made(const struct pins *pins, const struct fbd_box *box)
{
	const struct pou *pou = &pins->project->pou[pins->pou];
	const struct st_item *item = &pou->st->item[box->item];
	const char *text = project_text(pins->project, item->text);
	const int unit = unit_of(pins);
	uint32_t number = 0;
	int first, last, column;

	st_where(&pins->project->names, item, text, &first, &column);
	st_where(&pins->project->names, item, text + strlen(text), &last, &column);
	for (int i = 0; box->made && unit >= 0 && pins->il && i < pins->il->count; i++) {
		const struct il_line *line = &pins->il->line[i];

		number += is_listed(line);
		if (line->made == box->made && (int)line->line >= first && (int)line->line <= last)
			return code_listed(pins->resource->image.program, (uint32_t)unit, is_listed(line) ? number : number + 1);
	}
	return NULL;
}

static struct location made_place(const struct pins *pins, const struct fbd_box *box)
{
	const struct code_power *made = find_made(pins, box);

	if (!made || !pins->resource->image.memory[place_of(pins, made->in)])
		return (struct location){ .type = IEC_NONE };
	return (struct location){ .type = made->type ? (enum iec_type)made->type : IEC_BOOL,
				  .where = place_of(pins, made->out) };
}

/* ---- pins ---- */

static bool is_wire(const struct fbd_graph *graph, const char *name)
{
	for (int i = 0; i < graph->wire_count; i++)
		if (graph->wire[i].name && strcmp(graph->wire[i].name, name) == 0)
			return true;
	return false;
}

static struct location find_output(const struct pins *pins, int network, const struct fbd_graph *graph, int pin)
{
	const struct fbd_pin *p = &graph->pin[pin];
	const struct fbd_box *box = &graph->box[p->box];
	struct location at = { .type = IEC_NONE };
	char text[3 * LIMIT_NAME];

	if (box->made && (!*p->name || strcmp(p->name, "OUT") == 0))
		at = made_place(pins, box);
	if (at.type != IEC_NONE)
		return at;
	if (box->kind == FBD_BLOCK && box->instance && *p->name && !p->negated) {
		snprintf(text, sizeof(text), "%.*s.%.*s", LIMIT_NAME, box->instance, LIMIT_NAME, p->name);
		return find(pins, text);
	}
	if (p->operand)
		return find(pins, p->operand);
	for (int i = 0; i < graph->wire_count; i++)
		if (graph->wire[i].from_pin == pin && graph->wire[i].name)
			return find_wire(pins, network, graph->wire[i].name, false);
	return box->kind == FBD_VALUE && box->target ? find(pins, box->target) : at;
}

static struct location find_pin(const struct pins *pins, int network, const struct fbd_graph *graph, int pin)
{
	const struct fbd_pin *p = &graph->pin[pin];
	const int source = p->output ? pin : fbd_graph_source(graph, pin);

	if (p->operand && p->previous && is_wire(graph, p->operand))
		return find_wire(pins, network, p->operand, true);
	if (!p->output && p->operand)
		return find(pins, p->operand);
	return source >= 0 ? find_output(pins, network, graph, source) : (struct location){ .type = IEC_NONE };
}

bool pins_value(const struct pins *pins, int network, const struct fbd_graph *graph, int pin, char *text, size_t size,
		bool *on)
{
	const struct location at = find_pin(pins, network, graph, pin);
	const union iec_value value = at.type == IEC_NONE ? (union iec_value){ .i = 0 } :
						       image_get(&pins->resource->image, at);

	text[0] = '\0';
	*on = at.type == IEC_BOOL && value.i;
	if (at.type != IEC_NONE && at.type != IEC_BOOL)
		iec_value_print(at.type, value, text, size);
	return at.type != IEC_NONE;
}
