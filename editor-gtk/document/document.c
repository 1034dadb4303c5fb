/* SPDX-License-Identifier: MIT
 *
 * document - one rung file while a person works on it.
 *
 * Here: what there is, and what changes it. Files are document_file.c's, checks are
 * document_check.c's.
 */
#include "editor-gtk/document/document_inside.h"

#include <stdlib.h>
#include <string.h>

G_DEFINE_FINAL_TYPE(LadderDocument, ladder_document, G_TYPE_OBJECT)

enum { RUNGS_CHANGED, VARIABLE_CHANGED, PROJECT_CHANGED, LIST_CHANGED, BOOKMARKS_CHANGED,
       CHECKED, STATE_CHANGED, SIGNALS };
static guint signals[SIGNALS];

static const char EMPTY_PROJECT[] =
	"RUNGBOARD 1\n\nPROGRAM Main LD\nRUNG\nEND_PROGRAM\n";

/* ---- what there is ---- */

const char *document_file(const LadderDocument *document)
{
	return document->path ? document->path : "";
}

struct project *ladder_document_project(LadderDocument *document)
{
	return document->text ? NULL : ladder_project(document->ladder);
}

struct ladder *ladder_document_ladder(LadderDocument *document)
{
	return document->text ? NULL : document->ladder;
}

guint64 ladder_document_version(LadderDocument *document)
{
	return document->version;
}

const char *ladder_document_path(LadderDocument *document)
{
	return document->path;
}

char *ladder_document_name(LadderDocument *document)
{
	const struct project *project = ladder_document_project(document);

	if (project && project->title)
		return g_strdup(project_text(project, project->title));
	return document->path ? g_path_get_basename(document->path) :
	       g_strdup(_("New project"));
}

char *ladder_document_outline(LadderDocument *document, gsize *len,
			      void (*take)(void *context, const struct text_span *span),
			      void *context)
{
	char *text, *copy;

	if (document->text)
		return NULL;
	text = ladder_outline(document->ladder, len, take, context);
	copy = g_strdup(text);
	free(text);
	return copy;
}

/* ---- telling ---- */

void document_changed(LadderDocument *document)
{
	document->version++;
	document_check_later(document);
	g_signal_emit(document, signals[STATE_CHANGED], 0);
}

void document_tell_state(LadderDocument *document)
{
	g_signal_emit(document, signals[STATE_CHANGED], 0);
}

void document_tell_checked(LadderDocument *document)
{
	g_signal_emit(document, signals[CHECKED], 0);
}

void document_tell_variable(LadderDocument *document, int pou, const char *name,
			    const char *address)
{
	g_signal_emit(document, signals[VARIABLE_CHANGED], 0, pou, name, address);
}

void document_tell_list(LadderDocument *document, int pou)
{
	g_signal_emit(document, signals[LIST_CHANGED], 0, pou);
}

void document_tell_bookmarks(LadderDocument *document)
{
	g_signal_emit(document, signals[BOOKMARKS_CHANGED], 0);
}

void document_tell_whole(LadderDocument *document)
{
	g_signal_emit(document, signals[PROJECT_CHANGED], 0);
}

void document_tell_project(LadderDocument *document)
{
	document_tell_whole(document);
	document_changed(document);
}

/* ---- the text becomes the project ---- */

struct ladder *document_read(LadderDocument *document, const char *text, gsize len,
			     struct diag_list *why)
{
	struct ladder *ladder = ladder_new();
	const char *file = g_intern_string(document_file(document));

	if (!ladder)
		g_error("out of memory");
	if (ladder_load_text(ladder, file, text, len) && ladder_project(ladder))
		return ladder;
	if (why)
		*why = *ladder_diags(ladder);
	ladder_free(ladder);
	return NULL;
}

void document_take_ladder(LadderDocument *document, struct ladder *ladder)
{
	ladder_free(document->ladder);
	document->ladder = ladder;
	g_clear_pointer(&document->text, g_free);
}

/* Takes over what can be read; else the text itself. */
static void take_text(LadderDocument *document, const char *text, gsize len)
{
	struct ladder *ladder = document_read(document, text, len, NULL);

	if (ladder) {
		document_take_ladder(document, ladder);
		return;
	}
	g_free(document->text);
	document->text = memcpy(g_malloc0(len + 1), text, len);
	document->text_len = len;
}

void document_take(LadderDocument *document, const char *text, gsize len)
{
	g_hash_table_remove_all(document->list);
	take_text(document, text, len);
	history_restart(document->history);
	document_tell_project(document);
}

/* ---- applying a change, forwards or backwards ---- */

/* Better a stop than a wrong program. */
void document_report_lost(const char *what)
{
	g_error("the history does not fit the document: %s", what);
}

/* Bodies of a chart know their rungs by number. */
static void shift_bodies(struct sfc *sfc, int at, int by)
{
	for (int i = 0; i < sfc_bodies(sfc); i++) {
		struct sfc_body *body = i < sfc->transition_count ?
			&sfc->transition[i].condition :
			&sfc->action[i - sfc->transition_count].body;

		if (body->kind == BODY_LIST || body->kind == BODY_NONE)
			continue;
		if (body->first > at)
			body->first += by;
		else if (at < body->first + body->count)
			body->count += by;
	}
}

static void apply_rungs(LadderDocument *document, const struct change *change,
			const GPtrArray *from, const GPtrArray *to)
{
	struct project *project = ladder_project(document->ladder);
	struct pou *pou = &project->pou[change->pou];
	struct diag_list diags;

	diag_init(&diags);
	if (pou->sfc)
		shift_bodies(pou->sfc, (int)change->at, (int)to->len - (int)from->len);
	for (guint i = 0; i < from->len; i++)
		rung_free(project_take_rung(pou, (int)change->at));
	for (guint i = 0; i < to->len; i++) {
		const char *text = to->pdata[i];
		struct rung *rung = ladder_read_rung(document->ladder, text,
						     strlen(text), &diags);

		if (!rung || !project_add_rung(pou, (int)(change->at + i), rung))
			document_report_lost(text);
	}
	g_signal_emit(document, signals[RUNGS_CHANGED], 0, change->pou,
		      (int)change->at, (int)from->len, (int)to->len);
}

static char *spliced(const char *text, gsize len, gsize at, gsize removed,
		     const char *with, gsize *out_len)
{
	gsize insert = strlen(with);
	char *out = g_malloc(len - removed + insert + 1);

	memcpy(out, text, at);
	memcpy(out + at, with, insert);
	memcpy(out + at + insert, text + at + removed, len - at - removed + 1);
	*out_len = len - removed + insert;
	return out;
}

static char *plain_text(LadderDocument *document, gsize *len)
{
	char *text, *copy;

	if (document->text)
		return ladder_document_text(document, len);
	text = ladder_write(document->ladder, len);
	if (!text)
		g_error("out of memory");
	copy = g_strdup(text);
	free(text);
	return copy;
}

/* A change of text may take the document from text to project and back. */
static void apply_text(LadderDocument *document, const struct change *change,
		       const char *from, const char *to)
{
	gsize len, new_len;
	char *text = plain_text(document, &len), *out;

	if (change->at + strlen(from) > len ||
	    memcmp(text + change->at, from, strlen(from)) != 0)
		document_report_lost(from);
	out = spliced(text, len, change->at, strlen(from), to, &new_len);
	take_text(document, out, new_len);
	g_free(out);
	g_free(text);
	document_tell_whole(document);
}

static void apply(LadderDocument *document, const struct change *change, bool back)
{
	const GPtrArray *from = back ? change->after : change->before;
	const GPtrArray *to = back ? change->before : change->after;

	if (change->kind != CHANGE_LIST)
		document_forget_place(document);
	switch (change->kind) {
	case CHANGE_RUNGS:
		apply_rungs(document, change, from, to);
		break;
	case CHANGE_VARIABLE:
		document_apply_variable(document, change->pou, (int)change->at, from, to);
		break;
	case CHANGE_TEXT:
		apply_text(document, change, from->pdata[0], to->pdata[0]);
		break;
	case CHANGE_VIEW:
		document_apply_view(document, to->pdata[0]);
		break;
	case CHANGE_LIST:
		document_apply_list(document, change->pou, to->pdata[0]);
		break;
	case CHANGE_FILE:
		document_apply_file(document, change, from->pdata[0], to->pdata[0]);
		break;
	}
}

void document_record(LadderDocument *document, struct change *change)
{
	apply(document, change, false);
	history_add(document->history, change);
	document_changed(document);
}

/* ---- changes ---- */

void ladder_document_fix(LadderDocument *document)
{
	document->fixed = true;
	document_stop_checks(document);
}

bool ladder_document_is_fixed(LadderDocument *document)
{
	return document->fixed;
}

void ladder_document_begin(LadderDocument *document, const char *name, const char *key)
{
	history_begin(document->history, name, key);
}

void ladder_document_end(LadderDocument *document)
{
	if (history_end(document->history))
		document_tell_state(document);
}

static void apply_all(LadderDocument *document, const struct step *step, bool back)
{
	const int count = (int)step->change->len;

	for (int i = 0; i < count; i++)
		apply(document, step->change->pdata[back ? count - 1 - i : i], back);
	if (step_is_aside(step))
		document_tell_state(document);
	else
		document_changed(document);
}

void ladder_document_cancel(LadderDocument *document)
{
	const struct step *step = history_open_step(document->history);

	if (step && step->change->len > 0)
		apply_all(document, step, true);
	history_cancel(document->history);
}

bool ladder_document_undo(LadderDocument *document)
{
	const struct step *step = history_undo(document->history);

	if (step)
		apply_all(document, step, true);
	return step;
}

bool ladder_document_redo(LadderDocument *document)
{
	const struct step *step = history_redo(document->history);

	if (step)
		apply_all(document, step, false);
	return step;
}

const char *ladder_document_undo_name(LadderDocument *document)
{
	return history_undo_name(document->history);
}

const char *ladder_document_redo_name(LadderDocument *document)
{
	return history_redo_name(document->history);
}

/* Its text, if a file could hold it. */
static char *rung_text(LadderDocument *document, const struct rung *rung,
		       struct diag_list *why)
{
	struct diag_list diags;
	char *text = ladder_write_rung(document->ladder, rung), *copy = NULL;
	struct rung *again;

	diag_init(&diags);
	again = text ? ladder_read_rung(document->ladder, text, strlen(text), &diags) :
		NULL;
	if (again && rung_equal(again, rung))
		copy = g_strdup(text);
	else if (why)
		*why = diags;
	rung_free(again);
	free(text);
	return copy;
}

static bool same_texts(const GPtrArray *a, const GPtrArray *b)
{
	if (a->len != b->len)
		return false;
	for (guint i = 0; i < a->len; i++)
		if (strcmp(a->pdata[i], b->pdata[i]) != 0)
			return false;
	return true;
}

static bool add_texts(LadderDocument *document, GPtrArray *texts,
		      struct rung *const *rungs, int count, struct diag_list *why)
{
	for (int i = 0; i < count; i++) {
		char *text = rung_text(document, rungs[i], why);

		if (!text)
			return false;
		g_ptr_array_add(texts, text);
	}
	return true;
}

/* Of a chart: rungs of one body, some before and some after, so that it stays sure which;
 * a condition has one. */
static bool fits_body(const struct sfc *sfc, int at, int removed, int inserted)
{
	for (int i = 0; i < sfc_bodies(sfc); i++) {
		const struct sfc_body *body = sfc_body(sfc, i);

		if (body->kind == BODY_LIST || body->kind == BODY_NONE ||
		    at < body->first || at + removed > body->first + body->count)
			continue;
		return removed > 0 && inserted > 0 &&
		       (i >= sfc->transition_count || removed == inserted);
	}
	return false;
}

bool ladder_document_splice(LadderDocument *document, int pou, int at, int removed,
			    struct rung **rungs, int inserted, struct diag_list *why)
{
	struct project *project = ladder_document_project(document);
	GPtrArray *before = change_texts(), *after = change_texts();
	struct pou *of = project && pou >= 0 && pou < project->pou_count ?
		&project->pou[pou] : NULL;
	bool good = of && !document->fixed && of->language != LANGUAGE_IL && !of->included && at >= 0 &&
		(!of->sfc || fits_body(of->sfc, at, removed, inserted)) &&
		removed >= 0 && at + removed <= of->rung_count &&
		of->rung_count - removed + inserted <= LIMIT_RUNGS &&
		add_texts(document, before, of->rung + at, removed, why) &&
		add_texts(document, after, rungs, inserted, why);

	for (int i = 0; i < inserted; i++)
		rung_free(rungs[i]);
	if (good && !same_texts(before, after)) {
		ladder_document_begin(document, _("Edit rungs"), NULL);
		document_record(document, change_new(CHANGE_RUNGS, pou, (gsize)at, before, after));
		document_shift_bookmarks(document, pou, at, removed, inserted);
		ladder_document_end(document);
	} else {
		g_ptr_array_unref(before);
		g_ptr_array_unref(after);
	}
	return good;
}

bool ladder_document_put_rung(LadderDocument *document, int pou, int at,
			      struct rung *rung, struct diag_list *why)
{
	return ladder_document_splice(document, pou, at, 1, &rung, 1, why);
}

bool ladder_document_move_rung(LadderDocument *document, int pou, int from, int to)
{
	const struct project *project = ladder_document_project(document);
	struct rung *copy;
	char *view;
	bool good;

	if (!project || pou < 0 || pou >= project->pou_count || from < 0 || to < 0 ||
	    from >= project->pou[pou].rung_count || to >= project->pou[pou].rung_count)
		return false;
	copy = rung_copy(project->pou[pou].rung[from]);
	view = g_strdup(project_view(project));
	ladder_document_begin(document, _("Move rung"), NULL);
	good = ladder_document_splice(document, pou, from, 1, NULL, 0, NULL) &&
	       ladder_document_splice(document, pou, to, 0, &copy, 1, NULL);
	if (good)
		document_move_bookmarks(document, pou, from, to, view);
	ladder_document_end(document);
	g_free(view);
	return good;
}

GPtrArray *document_one_text(const char *text, gsize len)
{
	GPtrArray *texts = change_texts();

	g_ptr_array_add(texts, g_strndup(text, len));
	return texts;
}

/* What @text would be once it is read and written: NULL, and why, if it cannot be read
 * or has another number of POUs while lists stand beside them. */
static char *canonical(LadderDocument *document, const char *text, gsize len,
		       struct diag_list *why)
{
	struct ladder *ladder = document_read(document, text, len, why);
	char *out = NULL;
	gsize out_len;

	if (ladder && (g_hash_table_size(document->list) == 0 ||
		       ladder_project(ladder)->pou_count ==
		       ladder_project(document->ladder)->pou_count))
		out = ladder_write(ladder, &out_len);
	else if (ladder && why)
		*why = *ladder_diags(ladder);
	ladder_free(ladder);
	return out;
}

/* From one text to the other: what they have in common at both ends is left out. */
static struct change *text_change(const char *from, const char *to)
{
	gsize from_len = strlen(from), to_len = strlen(to), at = 0, end = 0;
	const gsize shorter = MIN(from_len, to_len);

	while (at < shorter && from[at] == to[at])
		at++;
	while (end < shorter - at &&
	       from[from_len - 1 - end] == to[to_len - 1 - end])
		end++;
	return change_new(CHANGE_TEXT, -1, at, document_one_text(from + at, from_len - at - end),
			  document_one_text(to + at, to_len - at - end));
}

bool ladder_document_replace(LadderDocument *document, gsize at, gsize removed,
			     const char *with, struct diag_list *why)
{
	gsize len, new_len;
	char *text = plain_text(document, &len), *out, *clean;
	bool good = false;

	if (why)
		diag_init(why);
	if (!document->fixed && at <= len && removed <= len - at) {
		out = spliced(text, len, at, removed, with, &new_len);
		clean = canonical(document, out, new_len, why);
		good = clean || document->text;
		if (good && strcmp(text, clean ? clean : out) != 0)
			document_record(document, text_change(text, clean ? clean : out));
		free(clean);
		g_free(out);
	}
	g_free(text);
	return good;
}

/* ---- life ---- */

static void ladder_document_finalize(GObject *object)
{
	LadderDocument *document = LADDER_DOCUMENT(object);

	document_stop_checks(document);
	ladder_free(document->ladder);
	ladder_free(document->checked);
	history_free(document->history);
	g_clear_pointer(&document->files, g_array_unref);
	g_hash_table_unref(document->list);
	g_free(document->text);
	g_free(document->path);
	g_free(document->disk_sum);
	G_OBJECT_CLASS(ladder_document_parent_class)->finalize(object);
}

static void ladder_document_class_init(LadderDocumentClass *class)
{
	const GType type = G_TYPE_FROM_CLASS(class);
	const GSignalFlags flags = G_SIGNAL_RUN_LAST;

	G_OBJECT_CLASS(class)->finalize = ladder_document_finalize;
	signals[RUNGS_CHANGED] = g_signal_new("rungs-changed", type, flags, 0, NULL,
		NULL, NULL, G_TYPE_NONE, 4, G_TYPE_INT, G_TYPE_INT, G_TYPE_INT,
		G_TYPE_INT);
	signals[VARIABLE_CHANGED] = g_signal_new("variable-changed", type, flags, 0, NULL,
		NULL, NULL, G_TYPE_NONE, 3, G_TYPE_INT, G_TYPE_STRING, G_TYPE_STRING);
	signals[PROJECT_CHANGED] = g_signal_new("project-changed", type, flags, 0, NULL,
		NULL, NULL, G_TYPE_NONE, 0);
	signals[LIST_CHANGED] = g_signal_new("list-changed", type, flags, 0, NULL,
		NULL, NULL, G_TYPE_NONE, 1, G_TYPE_INT);
	signals[BOOKMARKS_CHANGED] = g_signal_new("bookmarks-changed", type, flags, 0,
		NULL, NULL, NULL, G_TYPE_NONE, 0);
	signals[CHECKED] = g_signal_new("checked", type, flags, 0, NULL, NULL, NULL,
		G_TYPE_NONE, 0);
	signals[STATE_CHANGED] = g_signal_new("state-changed", type, flags, 0, NULL,
		NULL, NULL, G_TYPE_NONE, 0);
}

static void ladder_document_init(LadderDocument *document)
{
	document->history = history_new();
	document->list = g_hash_table_new_full(NULL, NULL, NULL, g_free);
	diag_init(&document->diags);
	take_text(document, EMPTY_PROJECT, strlen(EMPTY_PROJECT));
	document_check_later(document);
}

LadderDocument *ladder_document_new(void)
{
	return g_object_new(LADDER_TYPE_DOCUMENT, NULL);
}
