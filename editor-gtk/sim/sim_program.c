/* SPDX-License-Identifier: MIT
 *
 * sim_program - a project that was built to be simulated: see sim_program.h.
 */
#include "editor-gtk/sim/sim_program.h"

#include "editor-gtk/draw/place.h"
#include "editor-gtk/kit/diag_said.h"
#include "editor-gtk/kit/i18n.h"
#include "editor-gtk/document/iomap_beside.h"

#include <string.h>

/* ---- words ---- */

/* The line of a list counts from its heading. */
static char *place_of(const struct project *project, const struct fault_place *at)
{
	const char *name = at->pou ? at->pou : "";
	const int pou = project ? project_find_pou(project, name, strlen(name)) : -1;
	struct place_sheet sheet = { 0 };

	if (pou >= 0 && at->rung)
		return place_cell(&sheet, project, pou, (int)at->rung - 1, (int)at->row - 1,
				  (int)at->col - 1);
	if (pou >= 0 && at->line)
		return place_line(project, pou, MAX((int)at->line - project->pou[pou].line, 0));
	return g_strdup(name);
}

char *sim_place_words(const struct sim_program *program, const struct fault_place *at)
{
	return place_of(ladder_project(program->ladder), at);
}

char *sim_fault_words(const struct sim_program *program, const struct resource *resource)
{
	char *place = sim_place_words(program, &resource->fault_at), *text;
	const char *what = said(fault_text(resource->fault));

	/* A watchdog has no place. */
	if (!*place && resource->fault_at.task)
		text = g_strdup_printf(_("task %s: %s"), resource->fault_at.task, what);
	else if (!*place)
		text = g_strdup(what);
	else if (resource->fault_at.task)
		text = g_strdup_printf(_("task %s: %s: %s"), resource->fault_at.task,
				       what, place);
	else
		text = g_strdup_printf(_("%s: %s"), what, place);
	g_free(place);
	return text;
}

/* ---- errors ---- */

/* "Main, rung 2, row 1, column C: "Nobody" is not declared". Caller frees. */
static char *words_of(const struct project *project, const struct diag *diag)
{
	const struct fault_place at = { .pou = diag->pou, .rung = (uint32_t)diag->rung,
		.row = (uint32_t)diag->row, .col = (uint32_t)diag->col };
	char *what = diag_said_whole(diag);
	char *place = project && diag->pou && diag->rung ? place_of(project, &at) :
		      diag->line ? g_strdup_printf(_("line %d"), diag->line) : NULL;
	char *text = place ? g_strdup_printf(_("%s: %s"), place, what) : g_strdup(what);

	g_free(what);
	g_free(place);
	return text;
}

void sim_program_say_why(const struct project *project, const struct diag_list *diags,
			 GError **error)
{
	const struct diag *diag = diag_first_error(diags);
	char *text = diag ? words_of(project, diag) : NULL;

	g_set_error_literal(error, G_IO_ERROR, G_IO_ERROR_INVALID_DATA,
			    text ? text : _("Out of memory"));
	g_free(text);
}

struct sim_program *sim_program_new(const char *file, const char *text, gsize len,
				    GError **error)
{
	return sim_program_read(ladder_new(), file, text, len, error);
}

static bool build(struct ladder *ladder, const char *file, const char *text, gsize len)
{
	return ladder_load_text(ladder, file, text, len) && ladder_build(ladder);
}

static void take_map(struct sim_program *program, struct iomap_at_rest map)
{
	program->safe = map.safe;
	program->said = map.said;
	program->said_count = map.said_count;
}

static struct sim_program *read_program(struct ladder *reader, const char *file, const char *text,
					gsize len, bool listed, GError **error)
{
	struct sim_program *program = g_new0(struct sim_program, 1);

	g_atomic_ref_count_init(&program->count);
	program->text = g_strndup(text, len);
	program->ladder = reader;
	if (!program->ladder)
		g_error("out of memory");
	ladder_watch(program->ladder, true);
	ladder_watch_lists(program->ladder, listed);
	if (listed && !build(program->ladder, file, program->text, len))
		ladder_watch_lists(program->ladder, false);
	if (!ladder_program(program->ladder) &&
	    !build(program->ladder, file, program->text, len)) {
		sim_program_say_why(ladder_project(program->ladder), ladder_diags(program->ladder),
				    error);
		sim_program_unref(program);
		return NULL;
	}
	program->program = ladder_program(program->ladder);
	take_map(program, iomap_read_beside(g_str_equal(file, "-") ? NULL : file, &program->program->areas));
	return program;
}

struct sim_program *sim_program_read(struct ladder *reader, const char *file, const char *text,
				     gsize len, GError **error)
{
	return read_program(reader, file, text, len, false, error);
}

struct sim_program *sim_program_read_listed(struct ladder *reader, const char *file,
					    const char *text, gsize len, GError **error)
{
	return read_program(reader, file, text, len, true, error);
}

bool sim_program_open_image(struct sim_program *program, const void *bytes, gsize len)
{
	guint8 *image = g_memdup2(bytes, len);
	struct program opened;
	struct arena scratch;
	enum diag_id why;
	size_t where;
	bool good;

	arena_init(&scratch);
	good = len && code_open(image, len, &scratch, &opened, &why, &where);
	arena_free(&scratch);
	if (!good) {
		g_free(image);
		return false;
	}
	g_free(program->image);
	program->image = image;
	program->opened = opened;
	program->program = &program->opened;
	return true;
}

bool sim_program_runs(const struct sim_program *program, const struct program *image)
{
	if (program->program->header->crc == image->header->crc)
		return true;
	return program->program->header->data_size == image->header->data_size &&
	       code_is_same(program->program, image);
}

/* The text without its VIEW part. Caller frees. */
static char *plain_text(const struct sim_program *program)
{
	const struct project *project = ladder_project(program->ladder);
	const char *text = program->form ? program->form : program->text;
	const char *view = project ? project_view(project) : "";
	const char *at = *view ? strstr(text, view) : NULL;

	return at ? g_strdup_printf("%.*s%s", (int)(at - text), text, at + strlen(view)) : g_strdup(text);
}

/* @a and @b have the same areas. */
static bool is_map_same(const struct sim_program *a, const struct sim_program *b)
{
	if (a->said_count != b->said_count ||
	    (a->said_count && memcmp(a->said, b->said, (gsize)a->said_count * sizeof(a->said[0])) != 0))
		return false;
	return a->safe && b->safe ?
	       memcmp(a->safe, b->safe, 2 * a->program->areas.bytes[AREA_Q]) == 0 :
	       a->safe == b->safe;
}

/* Texts that were typed in another form have other lines. */
static bool is_code_same(const struct sim_program *a, const struct sim_program *b)
{
	const struct code_header *x = a->program->header, *y = b->program->header;

	if (x->size == y->size && memcmp(a->program->base, b->program->base, x->size) == 0)
		return true;
	return (a->form || b->form) && x->data_size == y->data_size && code_is_same(a->program, b->program);
}

void sim_program_set_form(struct sim_program *program, char *form)
{
	g_free(program->form);
	program->form = form;
}

bool sim_program_is_same(const struct sim_program *a, const struct sim_program *b)
{
	char *left, *right;
	bool same;

	if (!is_map_same(a, b))
		return false;
	left = g_strchomp(plain_text(a));
	right = g_strchomp(plain_text(b));
	same = strcmp(left, right) == 0 && is_code_same(a, b);
	g_free(left);
	g_free(right);
	return same;
}

struct sim_program *sim_program_ref(struct sim_program *program)
{
	if (program)
		g_atomic_ref_count_inc(&program->count);
	return program;
}

void sim_program_unref(struct sim_program *program)
{
	if (!program || !g_atomic_ref_count_dec(&program->count))
		return;
	ladder_free(program->ladder);
	g_free(program->text);
	g_free(program->form);
	g_free(program->safe);
	g_free(program->said);
	g_free(program->image);
	g_free(program);
}
