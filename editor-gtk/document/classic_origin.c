/* SPDX-License-Identifier: MIT
 *
 * classic_origin - remembers which original rung each rung comes from; see
 * classic_origin.h.
 */
#include "editor-gtk/document/classic_origin.h"
#include "engine/base/name.h"
#include "engine/model/fbd.h"

#include <stdlib.h>
#include <string.h>

struct came {
	const struct classic_rung *from; /* NULL: no original                  */
	const struct drawing *drawn;     /* the same of another tool           */
	guint text;                      /* hash of the rung's text            */
	bool known;                      /* set while two lists are matched    */
};

struct origin_pou {
	char *name;
	GArray *rung;                    /* of struct came, in the order of the document */
};

struct _LadderOrigin {
	GObject parent_instance;
	LadderDocument *document;
	char *path;
	struct ladder *ladder;
	GPtrArray *pous;                 /* of struct origin_pou               */
	GArray *lost;                    /* of struct came: deleted rungs, which undo or paste
					    may bring back */
};

G_DEFINE_FINAL_TYPE(LadderOrigin, ladder_origin, G_TYPE_OBJECT)

static void pou_free(gpointer data)
{
	struct origin_pou *pou = data;

	g_free(pou->name);
	g_array_unref(pou->rung);
	g_free(pou);
}

static struct came *came_at(GArray *list, guint index)
{
	return &g_array_index(list, struct came, index);
}

static struct came came_now(LadderOrigin *origin, int pou, int rung)
{
	const struct project *project = ladder_document_project(origin->document);
	char *text = ladder_write_rung(ladder_document_ladder(origin->document),
				       project->pou[pou].rung[rung]);
	struct came came = { .text = text ? g_str_hash(text) : 0 };

	free(text);
	return came;
}

/* ---- rungs before and after ---- */

static void take(struct came *now, struct came *was)
{
	now->from = was->from;
	now->drawn = was->drawn;
	now->known = was->known = true;
}

static void take_same(struct came *now, GArray *was)
{
	for (guint i = 0; i < was->len && !now->known; i++)
		if (!came_at(was, i)->known && came_at(was, i)->text == now->text)
			take(now, came_at(was, i));
}

static void take_lost(LadderOrigin *origin, struct came *now)
{
	for (guint i = origin->lost->len; i > 0 && !now->known; i--)
		if (came_at(origin->lost, i - 1)->text == now->text) {
			take(now, came_at(origin->lost, i - 1));
			g_array_remove_index_fast(origin->lost, i - 1);
		}
}

static void lose(LadderOrigin *origin, GArray *was)
{
	for (guint i = 0; i < was->len; i++)
		if (!came_at(was, i)->known && (came_at(was, i)->from || came_at(was, i)->drawn))
			g_array_append_vals(origin->lost, came_at(was, i), 1);
}

/* Rungs with the same text are the same. If the count did not change, the others were
 * edited. */
static void match(LadderOrigin *origin, GArray *was, GArray *now)
{
	for (guint i = 0; i < now->len; i++)
		take_same(came_at(now, i), was);
	for (guint i = 0; i < now->len && was->len == now->len; i++)
		if (!came_at(now, i)->known && !came_at(was, i)->known)
			take(came_at(now, i), came_at(was, i));
	for (guint i = 0; i < now->len; i++)
		take_lost(origin, came_at(now, i));
	lose(origin, was);
	for (guint i = 0; i < now->len; i++)
		came_at(now, i)->known = false;
}

static GArray *rungs_now(LadderOrigin *origin, int pou, int at, int count)
{
	GArray *now = g_array_new(FALSE, FALSE, sizeof(struct came));

	for (int i = at; i < at + count; i++) {
		const struct came came = came_now(origin, pou, i);

		g_array_append_val(now, came);
	}
	return now;
}

static void rungs_changed(LadderOrigin *origin, int pou, int at, int removed, int inserted)
{
	struct origin_pou *of = pou < (int)origin->pous->len ? origin->pous->pdata[pou] :
				NULL;
	GArray *was, *now;

	if (!of || (guint)(at + removed) > of->rung->len)
		return;
	was = g_array_new(FALSE, FALSE, sizeof(struct came));
	g_array_append_vals(was, of->rung->data + (gsize)at * sizeof(struct came),
			    (guint)removed);
	now = rungs_now(origin, pou, at, inserted);
	match(origin, was, now);
	g_array_remove_range(of->rung, (guint)at, (guint)removed);
	if (now->len)
		g_array_insert_vals(of->rung, (guint)at, now->data, now->len);
	g_array_unref(was);
	g_array_unref(now);
}

/* ---- when anything may be another ---- */

static const char *name_now(LadderOrigin *origin, int pou)
{
	const struct project *project = ladder_document_project(origin->document);

	return project_text(project, project->pou[pou].name);
}

static bool is_there(const LadderOrigin *origin, const char *name)
{
	const struct project *project = ladder_document_project(origin->document);

	return project_find_pou(project, name, strlen(name)) >= 0;
}

/* Finds the POU by its name, else by its number: then it was renamed. */
static struct origin_pou *was_called(LadderOrigin *origin, int pou)
{
	const char *name = name_now(origin, pou);
	struct origin_pou *of;

	for (guint i = 0; i < origin->pous->len; i++) {
		of = origin->pous->pdata[i];
		if (name_equal(of->name, name))
			return of;
	}
	of = pou < (int)origin->pous->len ? origin->pous->pdata[pou] : NULL;
	return of && !is_there(origin, of->name) ? of : NULL;
}

/* If the count is unchanged, rungs match by number: a renamed symbol changes many texts at
 * once. */
static void match_whole(LadderOrigin *origin, GArray *was, GArray *now)
{
	for (guint i = 0; i < now->len && was->len == now->len; i++)
		take(came_at(now, i), came_at(was, i));
	match(origin, was, now);
}

static void project_changed(LadderOrigin *origin)
{
	const struct project *project = ladder_document_project(origin->document);
	GPtrArray *pous;

	if (!project)
		return; /* a text that cannot be read now; a later change may mend it */
	pous = g_ptr_array_new_with_free_func(pou_free);
	for (int i = 0; i < project->pou_count; i++) {
		struct origin_pou *was = was_called(origin, i);
		struct origin_pou *of = g_new0(struct origin_pou, 1);

		of->name = g_strdup(name_now(origin, i));
		of->rung = rungs_now(origin, i, 0, project->pou[i].rung_count);
		if (was) {
			match_whole(origin, was->rung, of->rung);
			g_array_set_size(was->rung, 0);
		}
		g_ptr_array_add(pous, of);
	}
	for (guint i = 0; i < origin->pous->len; i++)
		lose(origin, ((struct origin_pou *)origin->pous->pdata[i])->rung);
	for (guint i = 0; i < pous->len; i++) {
		GArray *rungs = ((struct origin_pou *)pous->pdata[i])->rung;

		for (guint n = 0; n < rungs->len; n++)
			if (!came_at(rungs, n)->from && !came_at(rungs, n)->drawn)
				take_lost(origin, came_at(rungs, n));
		for (guint n = 0; n < rungs->len; n++)
			came_at(rungs, n)->known = false;
	}
	g_ptr_array_unref(origin->pous);
	origin->pous = pous;
}

/* ---- queries ---- */

const char *ladder_origin_path(LadderOrigin *origin)
{
	return origin->path;
}

const struct classic_project *ladder_origin_project(LadderOrigin *origin)
{
	return ladder_import_project(origin->ladder);
}

const struct classic_report *ladder_origin_report(LadderOrigin *origin)
{
	return ladder_import_report(origin->ladder);
}

const char *ladder_origin_io(LadderOrigin *origin)
{
	return ladder_import_io(origin->ladder);
}

const struct classic_rung *ladder_origin_of(LadderOrigin *origin, int pou, int rung)
{
	const struct origin_pou *of = pou >= 0 && pou < (int)origin->pous->len ?
				      origin->pous->pdata[pou] : NULL;

	return of && rung >= 0 && rung < (int)of->rung->len ?
	       came_at(of->rung, (guint)rung)->from : NULL;
}

/* Networks have no list of their own here: they are known by their number while none comes or goes. */
static const struct drawing *network_drawing(LadderOrigin *origin, int pou, int network)
{
	struct project *there = ladder_project(origin->ladder);
	const struct project *here = ladder_document_project(origin->document);
	const char *name = here && pou >= 0 && pou < here->pou_count ? name_now(origin, pou) : NULL;
	const int from = name && there ? project_find_pou(there, name, strlen(name)) : -1;

	if (from < 0 || !here->pou[pou].fbd || !there->pou[from].fbd ||
	    here->pou[pou].fbd->count != there->pou[from].fbd->count)
		return NULL;
	return ladder_import_drawing(origin->ladder, from, network);
}

const struct drawing *ladder_origin_drawing(LadderOrigin *origin, int pou, int number)
{
	const struct origin_pou *of = pou >= 0 && pou < (int)origin->pous->len ? origin->pous->pdata[pou] : NULL;

	if (of && number >= 0 && number < (int)of->rung->len)
		return came_at(of->rung, (guint)number)->drawn;
	return number >= 0 ? network_drawing(origin, pou, number) : NULL;
}

GArray *ladder_origin_became(LadderOrigin *origin, const struct classic_rung *from,
			     int *pou)
{
	GArray *all = g_array_new(FALSE, FALSE, sizeof(int));

	*pou = -1;
	for (guint i = 0; i < origin->pous->len && *pou < 0; i++) {
		GArray *rungs = ((struct origin_pou *)origin->pous->pdata[i])->rung;

		for (int n = 0; n < (int)rungs->len; n++)
			if (from && came_at(rungs, (guint)n)->from == from)
				g_array_append_val(all, n);
		if (all->len)
			*pou = (int)i;
	}
	return all;
}

static int last_line(const struct classic_rung *rung)
{
	int last = rung->place.line;

	for (int y = 0; y < CLASSIC_ROWS; y++)
		last = MAX(last, rung->row_line[y]);
	return last;
}

const struct classic_rung *ladder_origin_at(LadderOrigin *origin, const char *member,
					    int line)
{
	const struct classic_project *project = ladder_origin_project(origin);

	for (int i = 0; project && line > 0 && i < project->rungs; i++) {
		const struct classic_rung *rung = project->rung[i];

		if (strcmp(rung->place.member, member) == 0 && line >= rung->place.line &&
		    line <= last_line(rung))
			return rung;
	}
	return NULL;
}

/* ---- life ---- */

static void dispose(GObject *object)
{
	LadderOrigin *origin = LADDER_ORIGIN(object);

	g_clear_object(&origin->document);
	G_OBJECT_CLASS(ladder_origin_parent_class)->dispose(object);
}

static void finalize(GObject *object)
{
	LadderOrigin *origin = LADDER_ORIGIN(object);

	g_ptr_array_unref(origin->pous);
	g_array_unref(origin->lost);
	ladder_free(origin->ladder);
	g_free(origin->path);
	G_OBJECT_CLASS(ladder_origin_parent_class)->finalize(object);
}

static void ladder_origin_class_init(LadderOriginClass *class)
{
	G_OBJECT_CLASS(class)->dispose = dispose;
	G_OBJECT_CLASS(class)->finalize = finalize;
}

static void ladder_origin_init(LadderOrigin *origin)
{
	origin->pous = g_ptr_array_new_with_free_func(pou_free);
	origin->lost = g_array_new(FALSE, FALSE, sizeof(struct came));
}

/* At first the rungs stand where the engine put them. */
static void begin(LadderOrigin *origin)
{
	project_changed(origin);
	for (guint i = 0; i < origin->pous->len; i++) {
		GArray *rungs = ((struct origin_pou *)origin->pous->pdata[i])->rung;

		for (guint n = 0; n < rungs->len; n++) {
			came_at(rungs, n)->from =
				ladder_import_rung(origin->ladder, (int)i, (int)n);
			came_at(rungs, n)->drawn =
				ladder_import_drawing(origin->ladder, (int)i, (int)n);
		}
	}
}

LadderOrigin *ladder_origin_new(LadderDocument *document, char *path,
				struct ladder *ladder)
{
	LadderOrigin *origin = g_object_new(LADDER_TYPE_ORIGIN, NULL);

	origin->document = g_object_ref(document);
	origin->path = path;
	origin->ladder = ladder;
	ladder_document_set_from(document, path);
	begin(origin);
	g_signal_connect_object(document, "rungs-changed", G_CALLBACK(rungs_changed),
				origin, G_CONNECT_SWAPPED);
	g_signal_connect_object(document, "project-changed", G_CALLBACK(project_changed),
				origin, G_CONNECT_SWAPPED);
	return origin;
}
