/* SPDX-License-Identifier: MIT
 *
 * grid_view_rungs - what the verbs of a sheet do to whole rungs: to that of the cursor, or
 * to all of them if several are selected.
 *
 * Whatever they do is one step; what was selected stays so where it goes.
 */
#include "editor-gtk/ladder/grid_view_inside.h"

#include "editor-gtk/edit/entry_duplicate.h"
#include "editor-gtk/document/symbols.h"

#include <stdlib.h>

/* Selects them, with the cursor in the one that it is in, or at the end of them. */
static void select_rungs(LadderGridView *view, int first, int last)
{
	const bool down = view->cursor.rung >= view->anchor.rung;
	struct grid_cursor from = { down ? first : last, 0, 0 };
	struct grid_cursor to = { down ? last : first, view->cursor.row, view->cursor.col };

	if (first == last) {
		cursor_set(view, to, false);
		return;
	}
	cursor_set(view, from, false);
	cursor_set(view, to, true);
}

static bool splice(LadderGridView *view, int at, int removed, struct rung **rungs,
		   int inserted, enum verb verb)
{
	bool good;

	ladder_document_begin(view->document, _(verb_row(verb)->label), NULL);
	good = sheet_splice(view, at, removed, rungs, inserted, NULL);
	ladder_document_end(view->document);
	return good;
}

static void do_new(LadderGridView *view, enum verb verb)
{
	int first, last, at;
	struct rung *rung;

	cursor_rungs(view, &first, &last);
	at = MIN(verb == VERB_rung_below ? last + 1 : first, sheet_rungs(view));
	if (!sheet_pou(view))
		return;
	rung = rung_new(1, 1);
	if (splice(view, at, 0, &rung, 1, verb))
		cursor_set(view, (struct grid_cursor){ at, 0, 0 }, false);
}

/* A program without rungs is one a person cannot go on with: an empty one stays. */
static void do_delete(LadderGridView *view)
{
	struct rung *left = NULL;
	int first, last;

	cursor_rungs(view, &first, &last);
	if (last >= sheet_rungs(view))
		return;
	if (last - first + 1 == sheet_rungs(view))
		left = rung_new(1, 1);
	if (splice(view, first, last - first + 1, &left, left ? 1 : 0,
		   VERB_rung_delete))
		cursor_set(view, (struct grid_cursor){ first, 0, 0 }, false);
}

/* ---- once more ---- */

/* Copied: ids and rows end when the project is read anew. */
struct instance {
	char *name, *type;
	bool retain;
};

static struct instance *instances_new(struct project *project,
				      const struct entry_instance *made, int count)
{
	struct instance *instances = g_new0(struct instance, count + 1);

	for (int i = 0; i < count; i++)
		instances[i] = (struct instance){
			g_strdup(project_text(project, made[i].to)),
			g_strdup(words_row(&project->words, made[i].word)->word),
			made[i].retain,
		};
	return instances;
}

static void instances_free(struct instance *instances)
{
	for (int i = 0; instances[i].name; i++) {
		g_free(instances[i].name);
		g_free(instances[i].type);
	}
	g_free(instances);
}

static void declare(LadderGridView *view, const struct instance *one)
{
	const char *const text[SYMBOL_FIELDS] = {
		one->name, one->type, "", "", "1", "", "",
	};

	if (one->retain)
		symbol_add(view->document, view->pou + 1, 0, text, NULL);
	else
		ladder_document_declare(view->document, view->pou, one->name, one->type, "",
					NULL);
}

/* What was declared, to be told. Caller: g_free. */
static char *declare_all(LadderGridView *view, const struct instance *instances)
{
	GString *told = g_string_new(NULL);

	for (const struct instance *one = instances; one->name; one++) {
		declare(view, one);
		g_string_append_printf(told, "%s%s : %s%s", told->len ? "; " : "", one->name,
				       one->type, one->retain ? " RETAIN" : "");
	}
	return g_string_free(told, FALSE);
}

/* @rungs: taken over. */
static void put_twice(LadderGridView *view, int at, struct rung **rungs, int count,
		      const struct instance *instances)
{
	char *told = NULL;

	ladder_document_begin(view->document, _(verb_row(VERB_rung_duplicate)->label), NULL);
	if (sheet_splice(view, at, 0, rungs, count, NULL)) {
		told = declare_all(view, instances);
		select_rungs(view, at, at + count - 1);
		if (told && *told)
			sheet_tell(view, told);
	}
	ladder_document_end(view->document);
	g_free(told);
}

/* Two rungs with one timer would disturb each other: each has its own. */
static void do_duplicate(LadderGridView *view)
{
	const struct entry_place place = {
		.project = ladder_document_project(view->document), .pou = view->pou,
	};
	struct entry_instance *made;
	struct rung **copies;
	int first, last, count;
	struct instance *instances;

	cursor_rungs(view, &first, &last);
	if (last >= sheet_rungs(view))
		return;
	copies = g_new(struct rung *, last - first + 1);
	for (int i = first; i <= last; i++)
		copies[i - first] = sheet_rung(view, i);
	if (entry_duplicate(&place, copies, last - first + 1, &made, &count)) {
		for (int i = 0; i <= last - first; i++)
			copies[i]->label = 0; /* it could not stand twice */
		instances = instances_new(place.project, made, count);
		put_twice(view, last + 1, copies, last - first + 1, instances);
		instances_free(instances);
		free(made);
	}
	g_free(copies);
}

/* ---- elsewhere ---- */

/* In the body of a chart rungs change places by becoming each other. */
static bool move_in_body(LadderGridView *view, int from, int to)
{
	const int least = MIN(from, to), count = MAX(from, to) - least + 1;
	struct rung **rungs = g_new(struct rung *, count);
	bool good;

	for (int i = 0, at = least; i < count; i++) {
		if (least + i == to) {
			rungs[i] = rung_copy(sheet_rung(view, from));
			continue;
		}
		at += at == from;
		rungs[i] = rung_copy(sheet_rung(view, at++));
	}
	ladder_document_begin(view->document, _("Move rung"), NULL);
	good = sheet_splice(view, least, count, rungs, count, NULL);
	ladder_document_end(view->document);
	g_free(rungs);
	return good;
}

bool rungs_move(LadderGridView *view, int first, int last, int before)
{
	const int count = last - first + 1, down = before > last;
	bool good = before < first || before > last + 1;

	if (!good)
		return false;
	ladder_document_begin(view->document, _("Move rung"), NULL);
	for (int i = 0; good && i < count; i++)
		good = down ? ladder_document_move_rung(view->document, view->pou, first,
							before - 1) :
			      ladder_document_move_rung(view->document, view->pou, last,
							before);
	ladder_document_end(view->document);
	first = down ? before - count : before;
	if (count > 1)
		select_rungs(view, first, first + count - 1);
	else
		cursor_set(view, (struct grid_cursor){ first, view->cursor.row,
						       view->cursor.col }, false);
	return good;
}

/* The rung above or below them goes to their other side. */
static void do_move(LadderGridView *view, int by)
{
	const struct grid_cursor cursor = view->cursor;
	int first, last, from, to;
	bool several, good;

	several = cursor_rungs(view, &first, &last);
	from = by < 0 ? first - 1 : last + 1;
	to = by < 0 ? last : first;
	if (from < 0 || from >= sheet_rungs(view))
		return;
	good = view->count >= 0 ? move_in_body(view, from, to) :
	       ladder_document_move_rung(view->document, view->pou, from, to);
	if (good && several)
		select_rungs(view, first + by, last + by);
	else if (good)
		cursor_set(view, (struct grid_cursor){ cursor.rung + by, cursor.row,
						       cursor.col }, false);
}

/* All of them, if the first one is not. */
static void do_off(LadderGridView *view)
{
	const struct grid_cursor cursor = view->cursor, anchor = view->anchor;
	struct rung **rungs;
	int first, last;
	bool several, off;

	several = cursor_rungs(view, &first, &last);
	if (last >= sheet_rungs(view))
		return;
	rungs = g_new(struct rung *, last - first + 1);
	off = !sheet_rung(view, first)->off;
	for (int i = first; i <= last; i++) {
		rungs[i - first] = rung_copy(sheet_rung(view, i));
		rungs[i - first]->off = off;
	}
	if (splice(view, first, last - first + 1, rungs, last - first + 1, VERB_rung_off)) {
		if (several)
			cursor_set(view, anchor, false);
		cursor_set(view, cursor, several);
	}
	g_free(rungs);
}

/* ---- selecting ---- */

static bool is_all(LadderGridView *view)
{
	struct grid_area area;
	int first, last;

	if (cursor_rungs(view, &first, &last))
		return true;
	return cursor_area(view, &area) && area.row == 0 && area.col == 0 &&
	       area.last_row == sheet_rung(view, first)->rows - 1 &&
	       area.last_col == view->columns - 1;
}

/* The whole rung; of one that is selected already, all there are. */
static void do_select_all(LadderGridView *view)
{
	const bool all = sheet_rung(view, view->cursor.rung) && is_all(view);
	const int first = all ? 0 : view->cursor.rung;
	const int last = all ? sheet_rungs(view) - 1 : first;
	const struct rung *rung = sheet_rung(view, last);

	if (!rung)
		return;
	cursor_set(view, (struct grid_cursor){ first, 0, 0 }, false);
	cursor_set(view, (struct grid_cursor){ last, rung->rows - 1, view->columns - 1 },
		   true);
}

void rungs_do(LadderGridView *view, enum verb verb)
{
	switch ((int)verb) {
	case VERB_rung_below:
	case VERB_rung_above: do_new(view, verb); break;
	case VERB_rung_delete: do_delete(view); break;
	case VERB_rung_duplicate: do_duplicate(view); break;
	case VERB_rung_up: do_move(view, -1); break;
	case VERB_rung_down: do_move(view, 1); break;
	case VERB_rung_off: do_off(view); break;
	case VERB_select_all: do_select_all(view); break;
	default: break;
	}
}
