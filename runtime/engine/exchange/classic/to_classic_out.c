/* SPDX-License-Identifier: MIT
 *
 * to_classic_out - what the files of the export write with: messages, sections, empty rungs, elements and
 * expressions.
 */
#include "engine/exchange/classic/to_classic_parts.h"
#include "engine/exchange/foreign_text.h"

#include <stdio.h>
#include <string.h>

/* ---- messages ---- */

const char *out_text(struct leaving *e, const char *format, ...)
{
	va_list args;
	char *text;

	va_start(args, format);
	text = foreign_print(e->arena, format, args);
	va_end(args);
	e->good &= text != NULL;
	return text ? text : "";
}

static struct diag place_of(const struct leaving *e, enum diag_id id)
{
	struct diag place = { .id = id, .file = e->project->file };
	const struct rung *rung;

	if (!e->pou)
		return place;
	place.file = e->pou->file ? e->pou->file : e->project->file;
	place.pou = project_text(e->project, e->pou->name);
	place.line = e->pou->line;
	if (e->rung_index >= 0 && e->rung_index < e->pou->rung_count) {
		rung = e->pou->rung[e->rung_index];
		place.line = rung_line(rung, e->row);
		place.rung = e->pou->sfc ? 0 : e->rung_index + 1;
		place.row = e->row;
		place.col = e->col;
	}
	return place;
}

bool out_refuse(struct leaving *e, enum diag_id id, const char *format, ...)
{
	char text[LIMIT_ARG];
	va_list args;

	va_start(args, format);
	vsnprintf(text, sizeof(text), format, args);
	va_end(args);
	if (e->good)
		diag_add(e->diags, place_of(e, id), "%s", text);
	e->good = false;
	return false;
}

static __attribute__((format(printf, 4, 0)))
void tell_at(struct leaving *e, enum report_kind kind, struct diag place, const char *format,
	     va_list args)
{
	struct report_line line = { .kind = kind, .member = "",
		.line = place.line, .pou = place.pou, .rung = place.rung };
	char text[400];

	vsnprintf(text, sizeof(text), report_said(e->report, format), args);
	for (int i = 0; i < e->report->count; i++)
		if (!strcmp(e->report->line[i].text, text))
			return;
	report_add(e->report, line, "%s", text);
}

void tell_change(struct leaving *e, const char *format, ...)
{
	va_list args;

	va_start(args, format);
	tell_at(e, REPORT_CHANGED, place_of(e, DIAG_NO_MEMORY), format, args);
	va_end(args);
}

void tell_lost(struct leaving *e, const char *format, ...)
{
	va_list args;

	va_start(args, format);
	tell_at(e, REPORT_LOST, place_of(e, DIAG_NO_MEMORY), format, args);
	va_end(args);
}

void tell_line(struct leaving *e, int line, const char *format, ...)
{
	va_list args;

	va_start(args, format);
	tell_at(e, REPORT_CHANGED, (struct diag){ .line = line }, format, args);
	va_end(args);
}

/* ---- rungs ---- */

struct classic_variable variable_of(int type, int number)
{
	return (struct classic_variable){ type, number, -1, 0 };
}

const char *plain_title(struct leaving *e, const char *text)
{
	char *copy = arena_copy(e->arena, text, strlen(text)), *to = copy;
	bool quoted = text[0] == '"';

	for (const char *at = text + quoted; copy && *at; at++) {
		if (quoted && *at == '"' && !at[1])
			break;
		if (*at == '$' && at[1])
			at++;
		*to++ = *at;
	}
	if (copy)
		*to = '\0';
	return copy ? copy : "";
}

static void check_head(struct leaving *e, const struct classic_rung *rung)
{
	const int most = e->dialect == CLASSIC_UPSTREAM ? CLASSIC_COMMENT_LONG :
							  CLASSIC_COMMENT;

	if (strlen(rung->label) > CLASSIC_LABEL)
		tell_change(e, "label %s is cut to %d bytes", rung->label, CLASSIC_LABEL);
	if (strlen(rung->comment) > (size_t)most)
		tell_change(e, "a title is cut to %d bytes: %s", most, rung->comment);
}

struct classic_rung *rung_begin(struct leaving *e)
{
	struct classic_rung *rung = arena_alloc(e->arena, sizeof(*rung)), **slot;
	int number = e->out->rungs;

	if (!e->good || !rung || !e->section)
		return NULL;
	if (number >= 1900) {
		out_refuse(e, DIAG_EXPORT_MANY, "%d", number);
		return NULL;
	}
	slot = arena_push(e->arena, &e->out->rung, &e->out->rungs, sizeof(*slot));
	if (!slot)
		return NULL;
	*slot = rung;
	for (int i = 0; i < CLASSIC_ROWS * CLASSIC_COLUMNS; i++)
		rung->cell[i / CLASSIC_COLUMNS][i % CLASSIC_COLUMNS].variable =
			variable_of(0, 0);
	rung->number = number;
	rung->label = e->rung_label ? project_text(e->project, e->rung_label) : "";
	rung->comment = e->comment ? plain_title(e, e->comment) : "";
	check_head(e, rung);
	e->rung_label = 0;
	e->comment = NULL;
	rung->previous = e->section->first < 0 ? -1 : number - 1;
	rung->next = -1;
	if (e->section->first < 0)
		e->section->first = number;
	else
		e->out->rung[number - 1]->next = number;
	e->section->last = number;
	return rung;
}

/* Adds an expression once; returns its number. */
static int add_expression(struct leaving *e, const char *text)
{
	struct classic_expression *one;

	for (int i = 0; i < e->out->expressions; i++)
		if (!strcmp(e->out->expression[i].text, text))
			return i;
	if (e->out->expressions >= CLASSIC_LIMIT - 1) {
		out_refuse(e, DIAG_EXPORT_MANY, "%s", text);
		return 0;
	}
	one = arena_push(e->arena, &e->out->expression, &e->out->expressions, sizeof(*one));
	if (!one)
		return 0;
	one->number = e->out->expressions - 1;
	one->text = text;
	return one->number;
}

void note_jump(struct leaving *e, struct classic_cell *cell, const struct out_part *item)
{
	struct out_jump *jump = arena_push(e->arena, &e->jump, &e->jumps, sizeof(*jump));

	if (jump)
		*jump = (struct out_jump){ cell, item->label, item->leaves };
}

int routine_number(struct leaving *e, uint32_t name)
{
	const struct pou *pou = scope_pou(e->scope, e->pou, name);

	for (int i = 0; pou && i < e->routines; i++)
		if (e->routine[i] == pou)
			return i;
	return -1;
}

void out_put(struct leaving *e, struct classic_rung *rung, int y, int x,
	      const struct out_part *item)
{
	int alive = item->width - 1;
	struct classic_cell *cell;

	out_mark(e, item);
	for (int i = 0; i < item->height; i++)
		for (int k = 0; k < item->width; k++)
			rung->cell[y + i][x + k].element = CL_PART;
	cell = &rung->cell[y][x + alive];
	cell->element = item->code;
	cell->variable = item->text ? variable_of(0, add_expression(e, item->text)) :
			 item->code == CL_WIRE ? variable_of(0, 0) : item->variable;
}

/* ---- sections ---- */

static bool name_taken(const struct leaving *e, const char *name)
{
	for (int i = 0; i + 1 < e->out->sections; i++)
		if (!strcmp(e->out->section[i].name, name))
			return true;
	return false;
}

void section_begin(struct leaving *e, const char *name, int subroutine, bool sequential)
{
	struct classic_section *section = arena_push(e->arena, &e->out->section,
		&e->out->sections, sizeof(*section));

	e->labels = e->jumps = 0;
	e->label = NULL;
	e->jump = NULL;
	e->section = section;
	if (!section)
		return;
	*section = (struct classic_section){ .number = e->out->sections - 1,
		.sequential = sequential, .subroutine = subroutine, .first = -1,
		.last = -1 };
	section->name = out_text(e, "%.*s", classic_cut(name, CLASSIC_SECTION_NAME), name);
	for (int i = 2; name_taken(e, section->name) && i < 1000; i++)
		section->name = out_text(e, "%.*s_%d",
			classic_cut(name, CLASSIC_SECTION_NAME - 4), name, i);
	if (strcmp(name, section->name) != 0)
		tell_change(e, "section %s is called %s in ClassicLadder", name, section->name);
}

static void patch_jumps(struct leaving *e)
{
	int end = -1;

	for (int i = 0; i < e->jumps; i++) {
		const struct out_jump *jump = &e->jump[i];
		int to = -1;

		if (jump->leaves) {
			if (end < 0) {
				e->rung_label = 0;
				e->comment = NULL;
				end = rung_begin(e) ? e->out->rungs - 1 : 0;
			}
			to = end;
		}
		for (int k = 0; k < e->labels && to < 0; k++)
			if (e->label[k].label == jump->label)
				to = e->label[k].number;
		jump->cell->variable = variable_of(0, to < 0 ? 0 : to);
	}
}

void section_end(struct leaving *e, bool drop)
{
	if (!e->section)
		return;
	patch_jumps(e);
	if (drop && e->section->first < 0) {
		e->out->sections--;
	} else if (e->section->first < 0 && !e->section->sequential) {
		rung_begin(e);
	} else if (e->section->sequential) {
		e->section->first = e->section->last = 0;
	}
	e->section = NULL;
}

int blocks_end(const struct classic_blocks *blocks)
{
	return blocks->count ? blocks->block[blocks->count - 1].number + 1 : 0;
}
