/* SPDX-License-Identifier: MIT
 *
 * text_view - a program in IL or ST, or a file that cannot be read, as text.
 */
#include "editor-gtk/text/text_view.h"

#include "editor-gtk/kit/diag_said.h"
#include "editor-gtk/kit/i18n.h"
#include "editor-gtk/kit/left.h"
#include "editor-gtk/text/line_values.h"
#include "editor-gtk/text/st_typing.h"
#include "editor-gtk/text/text_complete.h"
#include "editor-gtk/text/text_found.h"
#include "editor-gtk/text/text_folds.h"
#include "editor-gtk/text/text_mend.h"
#include "editor-gtk/text/text_stops.h"
#include "editor-gtk/document/text_lines.h"
#include "editor-gtk/document/text_range.h"
#include "editor-gtk/sim/live_map.h"
#include "editor-gtk/sim/st_why.h"
#include "editor-gtk/kit/text_scheme.h"
#include "editor-gtk/kit/verbs.h"
#include "editor-gtk/kit/gtk48/text_scroll.h"
#include "editor-gtk/kit/gtk48/tip.h"
#include "engine/base/name.h"


#include <stdlib.h>
#include <string.h>

#define SEEN_MS 25   /* longer than a frame: the letter is drawn first          */
#define REST 2000000 /* us without a key: the next key begins a step              */

/* An error or warning in the shown text. */
struct flaw {
	int line, column; /* 0-based; column -1: none                          */
	char *text;
	struct diag diag;
};

struct _LadderTextView {
	GtkBox parent;
	LadderDocument *document;
	LadderSim *sim;          /* NULL: none                                 */
	int pou;
	struct text_range part;   /* which lines of the POU are shown            */
	bool lost;               /* they are not in it any more                 */
	struct text_stops *stops; /* NULL: it goes                              */
	struct text_folds *folds; /* likewise                                   */
	LadderLineValues *values; /* the text, with values beside its lines     */
	GtkSourceView *view;     /* the same                                   */
	GtkSourceBuffer *buffer;
	GtkTextTag *error, *warning;
	struct text_found *found; /* hits of a search; NULL: it goes             */
	GtkLabel *told;          /* why the line of the cursor is wrong         */
	GtkLabel *call;          /* what the call at the cursor takes           */
	GArray *faults;          /* of struct flaw, as of the last check       */
	bool ours;               /* the view itself changes the text            */
	int typed_line;          /* line, time and number of the last step of typing */
	gint64 typed_at;
	guint typed_step;
	guint foreseeing;        /* source that builds the text ahead; 0: none  */
	guint taking;            /* timer: puts the text into the document      */
	guint looking;           /* timer: looks for a call at the cursor       */
	int st_chart;            /* POU: a chart that has had statements; -1: none. While one is typed it may have none */
};

G_DEFINE_FINAL_TYPE(LadderTextView, ladder_text_view, GTK_TYPE_BOX)

/* (): the shown part has gone from the text, or has another name. */
static guint part_changed;

/* ---- the text ---- */

static char *text_of_buffer(LadderTextView *view);

/* The whole text of the POU or the file. NULL: there is none. Caller frees. */
static char *list_of_document(LadderTextView *view)
{
	return view->pou < 0 ? ladder_document_text(view->document, NULL) :
	       ladder_document_list(view->document, view->pou);
}

static bool is_action(LadderTextView *view)
{
	const struct project *project = ladder_document_project(view->document);

	return project && view->pou >= 0 && view->pou < project->pou_count &&
	       project->pou[view->pou].kind == POU_ACTION;
}

/* The text of the shown part in the document. NULL: the part is gone. Caller frees. */
static char *text_of_document(LadderTextView *view)
{
	char *list = list_of_document(view), *shown, *text;

	if (!list || view->part.kind == RANGE_WHOLE)
		return list;
	shown = text_of_buffer(view);
	text = text_range_find(&view->part, list, shown);
	g_free(shown);
	if (text || !is_action(view)) {
		g_free(list);
		return text;
	}
	text_range_clear(&view->part); /* its heading cannot be read */
	text_range_init(&view->part);
	return list;
}

static char *text_of_buffer(LadderTextView *view)
{
	GtkTextBuffer *buffer = GTK_TEXT_BUFFER(view->buffer);
	GtkTextIter start, end;

	gtk_text_buffer_get_bounds(buffer, &start, &end);
	return gtk_text_buffer_get_text(buffer, &start, &end, TRUE);
}

/* The text of the POU as it is with the shown one. Caller frees. */
static char *list_of_buffer(LadderTextView *view)
{
	char *shown = text_of_buffer(view), *list = text_range_whole(&view->part, shown);

	g_free(shown);
	return list;
}

/* Length of the common beginning, whole characters. */
static gsize common_start(const char *a, const char *b)
{
	gsize len = 0;

	while (a[len] && a[len] == b[len])
		len++;
	while (len > 0 && ((guchar)a[len] & 0xc0) == 0x80)
		len--;
	return len;
}

/* Length of the common end behind the first @start bytes. */
static gsize common_end(const char *a, const char *b, gsize start)
{
	const gsize len_a = strlen(a), len_b = strlen(b);
	gsize len = 0;

	while (len < len_a - start && len < len_b - start &&
	       a[len_a - 1 - len] == b[len_b - 1 - len])
		len++;
	while (len > 0 && ((guchar)a[len_a - len] & 0xc0) == 0x80)
		len--;
	return len;
}

/* Replaces only the part that differs: the cursor, the selection and the page stay, or move
 * there. */
static void exchange(LadderTextView *view, const char *now, const char *text)
{
	GtkTextBuffer *buffer = GTK_TEXT_BUFFER(view->buffer);
	const gsize start = common_start(now, text), end = common_end(now, text, start);
	const int from = (int)g_utf8_strlen(now, (gssize)start);
	const int gone = (int)g_utf8_strlen(now + start, (gssize)(strlen(now) - start - end));
	GtkTextIter at, to;

	gtk_text_buffer_get_iter_at_offset(buffer, &at, from);
	gtk_text_buffer_get_iter_at_offset(buffer, &to, from + gone);
	gtk_text_buffer_delete(buffer, &at, &to);
	gtk_text_buffer_insert(buffer, &at, text + start,
			       (int)(strlen(text) - start - end));
	if (!*now) { /* it is shown the first time: a search begins at its first line */
		gtk_text_buffer_get_start_iter(buffer, &at);
		gtk_text_buffer_place_cursor(buffer, &at);
	}
	if (!*now || !gtk_widget_has_focus(GTK_WIDGET(view->view)))
		return;
	gtk_text_buffer_place_cursor(buffer, &at);
	gtk_text_view_scroll_mark_onscreen(GTK_TEXT_VIEW(view->view),
					   gtk_text_buffer_get_insert(buffer));
}

/* An action of a program or a block is shown without its heading, if it can be read. */
static void choose_part(LadderTextView *view)
{
	char *list = view->part.kind == RANGE_WHOLE && is_action(view) ? list_of_document(view) : NULL;

	if (list)
		text_range_take(&view->part, list, text_range_heading(list));
	g_free(list);
}

/* A screen reader says which part it is. */
static void name_text(LadderTextView *view)
{
	char *name = ladder_text_view_part(view);

	gtk_accessible_update_property(GTK_ACCESSIBLE(view->view), GTK_ACCESSIBLE_PROPERTY_LABEL,
				       name, -1);
	g_free(name);
}

static void show_text(LadderTextView *view)
{
	char *name = g_strdup(view->part.name), *text, *now = text_of_buffer(view);
	const int lines = view->part.lines;
	bool changed;

	choose_part(view);
	text = text_of_document(view);
	view->lost = !text;
	changed = view->part.kind != RANGE_WHOLE && (!text || strcmp(name, view->part.name) != 0);
	if (text && strcmp(text, now) != 0) {
		view->ours = true;
		text_folds_keep(view->folds);
		exchange(view, now, text);
		text_folds_kept(view->folds);
		view->ours = false;
	}
	if (text && (strcmp(text, now) != 0 || lines != view->part.lines))
		text_stops_exchanged(view->stops);
	g_free(text);
	g_free(now);
	g_free(name);
	if (!changed)
		return;
	name_text(view);
	g_signal_emit(view, part_changed, 0);
}

static int cursor_line(LadderTextView *view)
{
	GtkTextBuffer *buffer = GTK_TEXT_BUFFER(view->buffer);
	GtkTextIter at;

	gtk_text_buffer_get_iter_at_mark(buffer, &at, gtk_text_buffer_get_insert(buffer));
	return gtk_text_iter_get_line(&at);
}

/* ---- typing ---- */

/* Typing in one line without a rest is one step. */
static char *step_key(LadderTextView *view)
{
	const gint64 now = g_get_monotonic_time();
	const int line = cursor_line(view);

	if (line != view->typed_line || now - view->typed_at > REST)
		view->typed_step++;
	view->typed_line = line;
	view->typed_at = now;
	return g_strdup_printf("text %p %u", (void *)view, view->typed_step);
}

/* This may destroy the view: a file that can be read again loses the page of its text. */
static void put(LadderTextView *view, LadderDocument *document)
{
	char *text = list_of_buffer(view), *before, *key = step_key(view);

	view->ours = true;
	text_stops_take(view->stops);
	ladder_document_begin(document, _("Type text"), key);
	if (view->pou >= 0) {
		ladder_document_put_list(document, view->pou, text);
	} else {
		before = ladder_document_text(document, NULL);
		ladder_document_replace(document, 0, strlen(before), text, NULL);
		g_free(before);
	}
	ladder_document_end(document);
	view->ours = false;
	if (view->stops)
		text_stops_taken(view->stops);
	g_free(key);
	g_free(text);
}

void ladder_text_view_take(LadderTextView *view)
{
	LadderDocument *document;

	if (!view->taking)
		return;
	g_clear_handle_id(&view->taking, g_source_remove);
	g_object_ref(view);
	document = g_object_ref(view->document);
	put(view, document);
	g_object_unref(document);
	g_object_unref(view);
}

static gboolean take_now(gpointer view)
{
	ladder_text_view_take(view);
	return G_SOURCE_REMOVE;
}

static void take_soon(LadderTextView *view, guint ms)
{
	g_clear_handle_id(&view->taking, g_source_remove);
	view->taking = g_timeout_add(ms, take_now, view);
}

static gboolean foresee(gpointer data)
{
	LadderTextView *view = data;
	char *text;

	view->foreseeing = 0;
	if (ladder_sim_is_building(view->sim))
		return G_SOURCE_REMOVE;
	text = list_of_buffer(view);
	ladder_sim_foresee(view->sim, ladder_document_with_list(view->document, view->pou, text));
	g_free(text);
	return G_SOURCE_REMOVE;
}

/* The simulation builds while the letter is drawn and the document reads the text, but when all
 * changes of this key are done. */
static void foresee_soon(LadderTextView *view)
{
	if (!view->foreseeing && view->pou >= 0 && view->sim && ladder_sim_is_on(view->sim) &&
	    !ladder_sim_board(view->sim))
		view->foreseeing = g_idle_add_full(G_PRIORITY_HIGH, foresee, view, NULL);
}

static void drawn(GdkFrameClock *clock, LadderTextView *view)
{
	g_signal_handlers_disconnect_by_func(clock, drawn, view);
	if (view->taking)
		take_soon(view, 0);
}

/* Delayed until the letter is drawn: reading a list beside thousands of rungs takes longer than
 * a frame. */
static void typed(LadderTextView *view)
{
	GdkFrameClock *clock = gtk_widget_get_frame_clock(GTK_WIDGET(view->view));

	if (view->ours || view->taking || view->lost || ladder_document_is_fixed(view->document))
		return;
	take_soon(view, SEEN_MS);
	foresee_soon(view);
	if (clock)
		g_signal_connect_object(clock, "after-paint", G_CALLBACK(drawn), view, 0);
}

gboolean ladder_text_view_is_st(LadderTextView *view)
{
	const struct project *project = ladder_document_project(view->document);

	const struct pou *pou = project && view->pou >= 0 && view->pou < project->pou_count ?
				&project->pou[view->pou] : NULL;

	if (pou && pou->sfc && text_is_st(pou))
		view->st_chart = view->pou;
	return pou && (text_is_st(pou) || (pou->sfc && view->st_chart == view->pou));
}

/* The POU may have got another name or language. */
static void name_pou(LadderTextView *view)
{
	const struct project *project = ladder_document_project(view->document);

	gtk_source_buffer_set_language(view->buffer, view->pou >= 0 ?
				       text_language_st(ladder_text_view_is_st(view)) :
				       text_language_of(view->document, view->pou));
	st_typing_set(view->view, ladder_text_view_is_st(view));
	line_values_set_st(view->values, ladder_text_view_is_st(view));
	line_values_set_pou(view->values, !project || view->pou < 0 ||
			    view->pou >= project->pou_count ? "" :
			    project_text(project, project->pou[view->pou].name));
	text_stops_renew(view->stops);
}

/* Does not replace text typed since. Whoever hears of a part that has gone may destroy the view. */
static void document_changed(LadderTextView *view)
{
	g_object_ref(view);
	if (!view->ours && !view->taking)
		show_text(view);
	else if (!view->ours)
		g_free(text_of_document(view)); /* the text around the part */
	if (view->stops)
		name_pou(view);
	g_object_unref(view);
}

static void variable_changed(LadderTextView *view, int pou)
{
	if (pou == view->pou)
		document_changed(view);
}

/* ---- errors ---- */

/* Marks a name or value to its end, else the rest of the line. */
static void end_of_word(const struct diag *diag, GtkTextIter *end)
{
	const int len = diag->column > 0 ? diag_name_length(diag) : 0;
	GtkTextIter to = *end, from = *end;
	char *text;

	gtk_text_iter_forward_to_line_end(&to);
	text = gtk_text_iter_get_slice(&from, &to);
	if (len > 0 && name_begins(diag->arg, (gsize)len, text, strlen(text)))
		gtk_text_iter_forward_chars(end, (int)g_utf8_strlen(diag->arg, len));
	else if (!gtk_text_iter_ends_line(end))
		*end = to;
	g_free(text);
}

static void mark(LadderTextView *view, const struct diag *diag, const struct flaw *fault)
{
	GtkTextBuffer *buffer = GTK_TEXT_BUFFER(view->buffer);
	GtkTextIter start, end;

	gtk_text_buffer_get_iter_at_line(buffer, &start, fault->line);
	if (fault->column > 0 && fault->column < gtk_text_iter_get_bytes_in_line(&start))
		gtk_text_iter_set_line_index(&start, fault->column);
	else
		while (gtk_text_iter_get_char(&start) == ' ' &&
		       gtk_text_iter_forward_char(&start))
			;
	end = start;
	end_of_word(diag, &end);
	gtk_text_buffer_apply_tag(buffer, diag_severity(diag->id) == SEVERITY_ERROR ?
				  view->error : view->warning, &start, &end);
}

static char *reason(const struct diag *diag)
{
	char *said = diag_said_whole(diag);
	char *text = g_strdup_printf("%s %s", diag_code(diag->id), said);

	g_free(said);
	return text;
}

/* The errors of a line, one below the other; NULL: none. Caller frees. */
static char *reasons_of(LadderTextView *view, int line)
{
	GString *text = NULL;

	for (guint i = 0; i < view->faults->len; i++) {
		const struct flaw *fault = &g_array_index(view->faults, struct flaw, i);

		if (fault->line != line)
			continue;
		if (!text)
			text = g_string_new(fault->text);
		else
			g_string_append_printf(text, "\n%s", fault->text);
	}
	return text ? g_string_free(text, FALSE) : NULL;
}

/* ---- the call at the cursor ---- */

static gboolean look_at_call(gpointer data)
{
	LadderTextView *view = data;
	GtkTextIter at;
	char *text, *call = NULL;

	view->looking = 0;
	gtk_text_buffer_get_iter_at_mark(GTK_TEXT_BUFFER(view->buffer), &at,
		gtk_text_buffer_get_insert(GTK_TEXT_BUFFER(view->buffer)));
	if (ladder_text_view_is_st(view)) {
		text = list_of_buffer(view);
		call = text_complete_call(view->document, view->pou, text,
					  view->part.lines + gtk_text_iter_get_line(&at),
					  gtk_text_iter_get_line_index(&at));
		g_free(text);
	}
	gtk_label_set_markup(view->call, call ? call : "");
	gtk_widget_set_visible(GTK_WIDGET(view->call), call != NULL);
	g_free(call);
	return G_SOURCE_REMOVE;
}

static void look_soon(LadderTextView *view)
{
	if (!view->looking)
		view->looking = g_timeout_add(SEEN_MS, look_at_call, view);
}

/* ---- mending ---- */

static gsize byte_of(const char *text, int line, int column)
{
	const char *at = text;

	for (; line > 0 && strchr(at, '\n'); line--)
		at = strchr(at, '\n') + 1;
	for (; column > 0 && *at && *at != '\n'; column--)
		at++;
	return (gsize)(at - text);
}

/* The first error of the cursor's line that mends itself. */
static gboolean find_mend(LadderTextView *view, const char *text, struct text_mend *out)
{
	const int line = cursor_line(view);

	for (guint i = 0; i < view->faults->len; i++) {
		const struct flaw *fault = &g_array_index(view->faults, struct flaw, i);

		if (fault->line == line && fault->column >= 0 &&
		    text_mend_find(text, byte_of(text, line, fault->column), &fault->diag, out))
			return TRUE;
	}
	return FALSE;
}

gboolean ladder_text_view_mend(LadderTextView *view)
{
	GtkTextBuffer *buffer = GTK_TEXT_BUFFER(view->buffer);
	char *text = text_of_buffer(view);
	struct text_mend mend;
	GtkTextIter at, to;
	const gboolean found = gtk_text_view_get_editable(GTK_TEXT_VIEW(view->view)) &&
			       find_mend(view, text, &mend);

	if (found) {
		gtk_text_buffer_get_iter_at_offset(buffer, &at,
			(int)g_utf8_strlen(text, (gssize)mend.at));
		to = at;
		gtk_text_iter_forward_chars(&to, (int)g_utf8_strlen(text + mend.at,
								    (gssize)mend.len));
		gtk_text_buffer_delete(buffer, &at, &to);
		gtk_text_buffer_insert(buffer, &at, mend.with, -1);
		g_free(mend.with);
	}
	g_free(text);
	return found;
}

/* The cursor stays in its line. */
static void show_formatted(LadderTextView *view)
{
	GtkTextBuffer *buffer = GTK_TEXT_BUFFER(view->buffer);
	char *before = text_of_buffer(view), *now;
	int count, *to, line = cursor_line(view);
	GtkTextIter at;

	text_folds_keep(view->folds);
	show_text(view);
	now = text_of_buffer(view);
	to = text_lines_match(before, now, &count);
	if (to && line < count && to[line] >= 0)
		line = to[line];
	if (strcmp(before, now) != 0) {
		gtk_text_buffer_get_iter_at_line(buffer, &at, line);
		gtk_text_buffer_place_cursor(buffer, &at);
		gtk_text_view_scroll_mark_onscreen(GTK_TEXT_VIEW(view->view),
						   gtk_text_buffer_get_insert(buffer));
	}
	text_folds_kept(view->folds);
	free(to);
	g_free(now);
	g_free(before);
}

gboolean ladder_text_view_format(LadderTextView *view)
{
	struct text_span span;
	char *canonical, *kept;
	gboolean readable;

	ladder_text_view_take(view);
	canonical = view->pou < 0 ? NULL : ladder_document_pou(view->document, view->pou, &span);
	if (!canonical)
		return FALSE;
	canonical[span.at + span.len] = '\0';
	kept = ladder_document_list(view->document, view->pou);
	readable = strcmp(kept, canonical + span.at) == 0;
	if (readable)
		show_formatted(view);
	g_free(kept);
	g_free(canonical);
	return readable;
}

static void tell_line(LadderTextView *view)
{
	char *text = reasons_of(view, cursor_line(view)), *all = text_of_buffer(view);
	struct text_mend mend;
	GString *with;

	if (text && find_mend(view, all, &mend)) {
		with = g_string_new(text);
		g_free(mend.with);
		g_free(text);
		verb_tell(with, VERB_mend);
		text = g_string_free(with, FALSE);
	}
	g_free(all);
	gtk_label_set_text(view->told, text ? text : "");
	g_free(text);
	look_soon(view);
}

/* ---- values ---- */

static bool was_before(GArray *parts, guint index)
{
	const char *name = g_array_index(parts, struct live_part, index).text;

	for (guint i = 0; i < index; i++) {
		const struct live_part *part = &g_array_index(parts, struct live_part, i);

		if (part->at.type != IEC_NONE && name_equal(part->text, name))
			return true;
	}
	return false;
}

static char *values_of_parts(GArray *parts, const struct image *image)
{
	GString *text = g_string_new(NULL);
	char value[48];

	for (guint i = 0; i < parts->len; i++) {
		const struct live_part *part = &g_array_index(parts, struct live_part, i);

		if (part->at.type == IEC_NONE || was_before(parts, i))
			continue;
		live_named_print(part->named, part->at.type, image_get(image, part->at),
				 value, sizeof(value));
		g_string_append_printf(text, "%s%s = %s", text->len ? " · " : "",
				       part->text, value);
	}
	return g_string_free(text, FALSE);
}

/* "Start = TRUE · Level = 12"; NULL: no simulation, or no variable in the line. Names are
 * looked up each time: tooltips are rare. Caller frees. */
static char *live_line(LadderSim *sim, const char *pou, const char *instance, const char *line)
{
	const struct twin *twin = sim ? ladder_sim_twin(sim) : NULL;
	const char *comment = strstr(line, "(*");
	struct live_map *map;
	GArray *parts;
	char *code, *text;

	if (!twin)
		return NULL;
	code = g_strndup(line, comment ? (gsize)(comment - line) : strlen(line));
	map = live_map_new(&twin->resource, pou, instance);
	live_map_set_sim(map, sim);
	parts = live_parts(map, code);
	text = parts ? values_of_parts(parts, &twin->resource.image) : NULL;
	if (parts)
		g_array_unref(parts);
	live_map_free(map);
	g_free(code);
	return text;
}

static char *values_of(LadderTextView *view, int line)
{
	const struct project *project = ladder_document_project(view->document);
	GtkTextIter start, end;
	char *text, *values;

	if (!view->sim || !project || view->pou < 0 || view->pou >= project->pou_count)
		return NULL;
	gtk_text_buffer_get_iter_at_line(GTK_TEXT_BUFFER(view->buffer), &start, line);
	end = start;
	gtk_text_iter_forward_to_line_end(&end);
	text = gtk_text_iter_get_text(&start, &end);
	values = live_line(view->sim, project_text(project,
		project->pou[view->pou].name), line_values_instance(view->values), text);
	g_free(text);
	return values;
}

char *ladder_text_view_why(LadderTextView *view)
{
	const struct project *project = ladder_document_project(view->document);
	char *text, *why;

	if (!view->sim || !ladder_text_view_is_st(view))
		return NULL;
	text = list_of_buffer(view);
	why = st_why(view->sim, project_text(project, project->pou[view->pou].name), text,
		     view->part.lines + cursor_line(view));
	g_free(text);
	return why;
}

/* Both are taken over; NULL: nothing. */
static char *joined(char *above, char *below)
{
	char *both;

	if (!above || !below)
		return above ? above : below;
	both = g_strdup_printf("%s\n%s", above, below);
	g_free(above);
	g_free(below);
	return both;
}

char *ladder_text_view_tip(LadderTextView *view, int line)
{
	return joined(joined(text_stops_say(view->stops, line - 1), reasons_of(view, line - 1)),
		      values_of(view, line - 1));
}

void ladder_text_view_set_sim(LadderTextView *view, LadderSim *sim)
{
	g_set_object(&view->sim, sim);
	line_values_set_sim(view->values, sim);
	text_stops_set_sim(view->stops, sim);
	name_pou(view);
}

static gboolean tell_pointed(GtkWidget *widget, int x, int y, gboolean by_keys,
			     GtkTooltip *tooltip, LadderTextView *view)
{
	GtkTextIter at;
	gboolean told;
	char *text;
	int line = cursor_line(view);

	if (!by_keys) {
		gtk_text_view_window_to_buffer_coords(GTK_TEXT_VIEW(widget),
			GTK_TEXT_WINDOW_WIDGET, x, y, &x, &y);
		gtk_text_view_get_line_at_y(GTK_TEXT_VIEW(widget), &at, y, NULL);
		line = gtk_text_iter_get_line(&at);
	}
	text = ladder_text_view_tip(view, line + 1);
	told = tip_show(tooltip, text);
	g_free(text);
	return told;
}

static void add_fault(LadderTextView *view, const struct diag *diag, int before,
		      const char *shown, const char *canonical)
{
	struct flaw fault = { diag->line - 1 - before, diag->column - 1, NULL, *diag };
	const int last = text_lines_count(canonical);

	if (fault.line < 0)
		return;
	if (view->part.kind != RANGE_WHOLE && fault.line > last) {
		if (fault.line > last + 1)
			return;
		fault.line = last; /* something lacks before the end            */
		fault.column = -1;
	}
	text_lines_place(shown, canonical, &fault.line, &fault.column);
	if (fault.line >= gtk_text_buffer_get_line_count(GTK_TEXT_BUFFER(view->buffer)))
		return;
	fault.text = reason(diag);
	g_array_append_val(view->faults, fault);
	mark(view, diag, &fault);
}

static void show_errors(LadderTextView *view)
{
	GtkTextBuffer *buffer = GTK_TEXT_BUFFER(view->buffer);
	const struct diag_list *diags = ladder_document_diags(view->document);
	char *shown = text_of_buffer(view), *canonical = text_of_document(view);
	const int before = ladder_document_lines_before(view->document, view->pou) + view->part.lines;
	const int lines = canonical ? text_lines_count(canonical) + (view->part.kind != RANGE_WHOLE) : 0;
	GtkTextIter start, end;

	gtk_text_buffer_get_bounds(buffer, &start, &end);
	gtk_text_buffer_remove_tag(buffer, view->error, &start, &end);
	gtk_text_buffer_remove_tag(buffer, view->warning, &start, &end);
	g_array_set_size(view->faults, 0);
	for (int i = 0; canonical && i < diags->count; i++)
		if (diags->diag[i].line - 1 - before <= lines)
			add_fault(view, &diags->diag[i], before, shown, canonical);
	g_free(shown);
	g_free(canonical);
	tell_line(view);
}

/* ---- from outside ---- */

int ladder_text_view_pou(LadderTextView *view)
{
	return view->pou;
}

void ladder_text_view_set_pou(LadderTextView *view, int pou)
{
	text_stops_leave(view->stops);
	view->pou = pou;
	text_range_clear(&view->part);
	text_range_init(&view->part);
	show_text(view);
	name_text(view);
	name_pou(view);
}

void ladder_text_view_set_part(LadderTextView *view, int line)
{
	char *list;

	ladder_text_view_take(view);
	list = list_of_document(view);
	if (!list || !text_range_take(&view->part, list, line - 1)) {
		text_range_clear(&view->part);
		text_range_init(&view->part);
	}
	g_free(list);
	text_stops_leave(view->stops);
	show_text(view);
	name_text(view);
	name_pou(view);
	show_errors(view);
}

bool ladder_text_view_has(LadderTextView *view, int line)
{
	char *text;
	bool has;

	if (view->part.kind == RANGE_WHOLE)
		return true;
	text = text_of_document(view);
	has = text && line > view->part.lines && line <= view->part.lines + 1 + text_lines_count(text);
	g_free(text);
	return has;
}

char *ladder_text_view_part(LadderTextView *view)
{
	switch (view->lost ? RANGE_WHOLE : view->part.kind) {
	case RANGE_BOX:
		return view->part.name[0] ? g_strdup_printf(_("Statements of %s"), view->part.name) :
		       g_strdup(_("Statements of the box"));
	case RANGE_ACTION:
		return g_strdup_printf(_("Text of action %s"), view->part.name);
	case RANGE_WHOLE:
		break;
	}
	return view->lost ? NULL : g_strdup(_("Text of the program"));
}

void ladder_text_view_toggle_stop(LadderTextView *view)
{
	text_stops_toggle(view->stops, cursor_line(view));
	line_values_tell(view->values);
}

void ladder_text_view_ask_stop(LadderTextView *view)
{
	text_stops_ask(view->stops, cursor_line(view));
}

bool ladder_text_view_fold(LadderTextView *view, bool fold)
{
	return fold ? text_folds_close(view->folds, cursor_line(view)) :
		      text_folds_open(view->folds, cursor_line(view));
}

void ladder_text_view_fold_all(LadderTextView *view, bool fold)
{
	if (fold)
		text_folds_close_all(view->folds);
	else
		text_folds_open_all(view->folds);
}

bool ladder_text_view_run_here(LadderTextView *view)
{
	return view->sim && ladder_sim_run_to(view->sim, view->pou,
					      view->part.lines + cursor_line(view));
}

GtkSourceBuffer *ladder_text_view_buffer(LadderTextView *view)
{
	return view->buffer;
}

static gboolean ends_name(gunichar c, gpointer address)
{
	return !(g_unichar_isalnum(c) || c == '_' || (address && (c == '%' || c == '.')));
}

/* The word around @at. */
static char *word_at(const GtkTextIter *at, gpointer address)
{
	GtkTextIter from = *at, to = *at;

	while (gtk_text_iter_backward_char(&from))
		if (ends_name(gtk_text_iter_get_char(&from), address)) {
			gtk_text_iter_forward_char(&from);
			break;
		}
	if (!ends_name(gtk_text_iter_get_char(&to), address))
		gtk_text_iter_forward_find_char(&to, ends_name, address, NULL);
	return gtk_text_iter_get_slice(&from, &to);
}

char *ladder_text_view_name(LadderTextView *view)
{
	GtkTextBuffer *buffer = GTK_TEXT_BUFFER(view->buffer);
	GtkTextIter at;
	char *word;

	gtk_text_buffer_get_iter_at_mark(buffer, &at, gtk_text_buffer_get_insert(buffer));
	word = word_at(&at, buffer); /* may be an address */
	if (*word != '%') {
		g_free(word);
		word = word_at(&at, NULL);
	}
	if (*word)
		return word;
	g_free(word);
	return NULL;
}

bool ladder_text_view_is_at(LadderTextView *view, int line)
{
	GtkTextBuffer *buffer = GTK_TEXT_BUFFER(view->buffer);
	char *shown = text_of_buffer(view), *canonical = text_of_document(view);
	GtkTextIter at;

	line -= view->part.lines + 1;
	if (canonical && line >= 0)
		text_lines_place(shown, canonical, &line, NULL);
	gtk_text_buffer_get_iter_at_mark(buffer, &at, gtk_text_buffer_get_insert(buffer));
	g_free(canonical);
	g_free(shown);
	return gtk_text_iter_get_line(&at) == line;
}

/* From 1, of the list as a file holds it, to 0-based, of the shown text. */
static void shown_place(LadderTextView *view, int *line, int *column)
{
	char *shown = text_of_buffer(view), *canonical = text_of_document(view);

	*line = MAX(*line - 1 - view->part.lines, 0);
	--*column;
	if (canonical)
		text_lines_place(shown, canonical, line, column);
	g_free(shown);
	g_free(canonical);
}

int ladder_text_view_row(LadderTextView *view)
{
	return view->part.lines + cursor_line(view);
}

void ladder_text_view_set_found(LadderTextView *view, const struct find_seen *seen)
{
	const struct find_hit *hit, *any = NULL;
	int at = 0, line = -1, column = 0;
	bool now;

	while ((hit = find_seen_next(seen, view->pou, &at, &now)) != NULL) {
		if (hit->where != FIND_LISTS)
			continue;
		any = hit;
		if (!now)
			continue;
		line = hit->row + 1;
		column = hit->col + 1;
		shown_place(view, &line, &column);
	}
	text_found_show(view->found, any ? seen->find : NULL, line, column, seen->all);
}

void ladder_text_view_go_here(LadderTextView *view, int line, int column)
{
	GtkTextBuffer *buffer = GTK_TEXT_BUFFER(view->buffer);
	GtkTextIter at;

	shown_place(view, &line, &column);
	gtk_text_buffer_get_iter_at_line(buffer, &at, line);
	if (column > 0 && column < gtk_text_iter_get_bytes_in_line(&at))
		gtk_text_iter_set_line_index(&at, column);
	gtk_text_buffer_place_cursor(buffer, &at);
	text_scroll_to_cursor(GTK_TEXT_VIEW(view->view));
	gtk_widget_grab_focus(GTK_WIDGET(view->view));
}

void ladder_text_view_go(LadderTextView *view, int line, int column)
{
	ladder_text_view_go_here(view, line - ladder_document_lines_before(view->document,
									 view->pou), column);
}

/* ---- life ---- */

static void ladder_text_view_dispose(GObject *object)
{
	LadderTextView *view = LADDER_TEXT_VIEW(object);

	/* Nothing below asks for a timer again. */
	if (view->buffer)
		g_signal_handlers_disconnect_by_data(view->buffer, view);
	g_clear_pointer(&view->found, text_found_free);
	g_clear_object(&view->buffer);
	g_clear_handle_id(&view->taking, g_source_remove);
	g_clear_handle_id(&view->looking, g_source_remove);
	g_clear_handle_id(&view->foreseeing, g_source_remove);
	line_values_set_note(view->values, NULL, NULL);
	g_clear_pointer(&view->stops, text_stops_free);
	g_clear_pointer(&view->folds, text_folds_free);
	if (view->document)
		g_signal_handlers_disconnect_by_data(view->document, view);
	g_clear_object(&view->document);
	g_clear_object(&view->sim);
	G_OBJECT_CLASS(ladder_text_view_parent_class)->dispose(object);
}

static void ladder_text_view_finalize(GObject *object)
{
	LadderTextView *view = LADDER_TEXT_VIEW(object);

	g_array_unref(view->faults);
	text_range_clear(&view->part);
	G_OBJECT_CLASS(ladder_text_view_parent_class)->finalize(object);
}

/* The focus goes to the text inside. */
static gboolean ladder_text_view_grab_focus(GtkWidget *widget)
{
	return gtk_widget_grab_focus(GTK_WIDGET(LADDER_TEXT_VIEW(widget)->view));
}

static void ladder_text_view_class_init(LadderTextViewClass *class)
{
	part_changed = g_signal_new("part-changed", G_TYPE_FROM_CLASS(class), G_SIGNAL_RUN_LAST, 0,
				    NULL, NULL, NULL, G_TYPE_NONE, 0);
	GTK_WIDGET_CLASS(class)->grab_focus = ladder_text_view_grab_focus;
	G_OBJECT_CLASS(class)->dispose = ladder_text_view_dispose;
	G_OBJECT_CLASS(class)->finalize = ladder_text_view_finalize;
}

static void make_buffer(LadderTextView *view)
{
	GtkTextBuffer *buffer;

	view->buffer = gtk_source_buffer_new(NULL);
	buffer = GTK_TEXT_BUFFER(view->buffer);
	/* Undo is the document's. */
	gtk_text_buffer_set_enable_undo(buffer, FALSE);
	view->error = gtk_text_buffer_create_tag(buffer, NULL, "underline",
						 PANGO_UNDERLINE_ERROR, NULL);
	view->warning = gtk_text_buffer_create_tag(buffer, NULL, "underline",
						   PANGO_UNDERLINE_SINGLE, NULL);
	view->found = text_found_new(buffer);
	g_signal_connect_swapped(buffer, "changed", G_CALLBACK(typed), view);
	g_signal_connect_swapped(buffer, "notify::cursor-position",
				 G_CALLBACK(tell_line), view);
}

static void clear_fault(gpointer fault)
{
	g_free(((struct flaw *)fault)->text);
}

static void ladder_text_view_init(LadderTextView *view)
{
	view->st_chart = -1;
	text_range_init(&view->part);
	view->faults = g_array_new(FALSE, FALSE, sizeof(struct flaw));
	g_array_set_clear_func(view->faults, clear_fault);
	gtk_orientable_set_orientation(GTK_ORIENTABLE(view), GTK_ORIENTATION_VERTICAL);
}

static char *say_line(void *data, int line)
{
	LadderTextView *view = data;
	char *stops = text_stops_say(view->stops, line), *folded = text_folds_say(view->folds, line);
	char *both = stops && folded ? g_strdup_printf("%s · %s", folded, stops) :
		     g_strdup(folded ? folded : stops);

	g_free(stops);
	g_free(folded);
	return both;
}

static gpointer note_letters(GtkWidget *text, gpointer data)
{
	LadderTextView *view = data;

	(void)text;
	return view->taking ? g_object_ref(view) : NULL;
}

static void take_letters(gpointer view)
{
	ladder_text_view_take(view);
}

static void build(LadderTextView *view)
{
	GtkWidget *scroller = gtk_scrolled_window_new();
	GtkEventController *keys;

	make_buffer(view);
	view->values = line_values_new(view->buffer);
	view->view = GTK_SOURCE_VIEW(view->values);
	view->told = GTK_LABEL(gtk_label_new(""));
	view->call = GTK_LABEL(gtk_label_new(""));
	gtk_source_view_set_highlight_current_line(view->view, TRUE);
	gtk_source_view_set_auto_indent(view->view, TRUE);
	gtk_widget_set_vexpand(scroller, TRUE);
	gtk_scrolled_window_set_overlay_scrolling(GTK_SCROLLED_WINDOW(scroller), FALSE);
	gtk_scrolled_window_set_child(GTK_SCROLLED_WINDOW(scroller),
				      GTK_WIDGET(view->view));
	gtk_label_set_xalign(view->told, 0);
	gtk_widget_set_margin_start(GTK_WIDGET(view->told), 14);
	gtk_widget_add_css_class(GTK_WIDGET(view->told), "error");
	gtk_box_append(GTK_BOX(view), scroller);
	gtk_label_set_xalign(view->call, 0);
	gtk_label_set_ellipsize(view->call, PANGO_ELLIPSIZE_END);
	gtk_widget_set_margin_start(GTK_WIDGET(view->call), 14);
	gtk_widget_add_css_class(GTK_WIDGET(view->call), "monospace");
	gtk_widget_set_visible(GTK_WIDGET(view->call), FALSE);
	gtk_box_append(GTK_BOX(view), GTK_WIDGET(view->call));
	gtk_box_append(GTK_BOX(view), GTK_WIDGET(view->told));
	left_connect(GTK_WIDGET(view->view), note_letters, take_letters, g_object_unref, view);
	view->folds = text_folds_new(view->values);
	line_values_set_part(view->values, &view->part);
	view->stops = text_stops_new(view->values, view->document, &view->pou, &view->part);
	line_values_set_note(view->values, say_line, view);
	keys = verbs_controller(VERB_TEXT);
	gtk_event_controller_set_propagation_phase(keys, GTK_PHASE_CAPTURE);
	gtk_widget_add_controller(GTK_WIDGET(view->view), keys);
	text_complete_attach(view->view, view->document, &view->pou, &view->part);
	gtk_widget_set_has_tooltip(GTK_WIDGET(view->view), TRUE);
	g_signal_connect(view->view, "query-tooltip", G_CALLBACK(tell_pointed), view);
}

GtkWidget *ladder_text_view_new(LadderDocument *document, int pou)
{
	LadderTextView *view = g_object_new(LADDER_TYPE_TEXT_VIEW, NULL);

	view->document = g_object_ref(document);
	view->pou = pou;
	build(view);
	gtk_text_view_set_editable(GTK_TEXT_VIEW(view->view),
				   !ladder_document_is_fixed(document));
	g_signal_connect_swapped(document, "rungs-changed", G_CALLBACK(document_changed),
				 view);
	g_signal_connect_swapped(document, "project-changed", G_CALLBACK(document_changed),
				 view);
	g_signal_connect_swapped(document, "variable-changed",
				 G_CALLBACK(variable_changed), view);
	g_signal_connect_swapped(document, "list-changed", G_CALLBACK(document_changed),
				 view);
	g_signal_connect_swapped(document, "checked", G_CALLBACK(show_errors), view);
	text_scheme_follow(view->buffer);
	show_text(view);
	name_text(view);
	name_pou(view);
	return GTK_WIDGET(view);
}
