/* SPDX-License-Identifier: MIT
 *
 * fbd_view_edit - the verbs that change networks, and the clipboard.
 *
 * The text of a network is that of its span in the canonical text; an edit exchanges only lines that differ.
 */
#include "editor-gtk/fbd/fbd_view_inside.h"

#include "editor-gtk/edit/entry_names.h"
#include "editor-gtk/edit/fbd_instances.h"
#include "editor-gtk/kit/comment_text.h"

#include "engine/base/name.h"

#include <stdlib.h>
#include <string.h>

/* ---- the text of a network ---- */

struct wanted {
	int pou, network;
	struct text_span span, body;
	bool found;
};

static void take_span(void *context, const struct text_span *span)
{
	struct wanted *wanted = context;

	if (span->pou != wanted->pou)
		return;
	if (span->part == TEXT_BODY)
		wanted->body = *span;
	if (span->part == TEXT_RUNG && span->number == wanted->network) {
		wanted->span = *span;
		wanted->found = true;
	}
}

/* The canonical text of the project, with the place of a network. Caller frees. */
static char *text_with(LadderFbdView *view, struct wanted *wanted)
{
	gsize len;

	return ladder_document_outline(view->canvas->document, &len, take_span, wanted);
}

/* Replaces only the lines that differ. */
static bool exchange(LadderFbdView *view, const char *whole, gsize at, gsize old_len, const char *text)
{
	const char *old = whole + at;
	gsize start = 0, end = 0;
	const gsize new_len = strlen(text);
	char *with;
	bool good;

	while (start < old_len && start < new_len && old[start] == text[start])
		start++;
	while (start > 0 && old[start - 1] != '\n')
		start--;
	while (end < old_len - start && end < new_len - start && old[old_len - 1 - end] == text[new_len - 1 - end])
		end++;
	while (end > 0 && old[old_len - end - 1] != '\n')
		end--;
	with = g_strndup(text + start, new_len - start - end);
	good = (old_len - start - end == 0 && !with[0]) ||
	       ladder_document_replace(view->canvas->document, at + start, old_len - start - end, with, NULL);
	if (!good)
		canvas_tell(LADDER_CANVAS(view), _("The network cannot hold this."));
	g_free(with);
	return good;
}

struct fbd_edit *fbd_begin(LadderFbdView *view, int network)
{
	struct wanted wanted = { .pou = view->canvas->pou, .network = network };
	char *whole = network >= 0 && fbd_pou(view) ? text_with(view, &wanted) : NULL;
	struct fbd_edit *edit = NULL;

	if (whole && wanted.found) {
		const char *text = whole + wanted.span.at;
		const gsize head = fbd_heading_len(text, wanted.span.len);

		edit = fbd_edit_new(ladder_document_project(view->canvas->document), view->canvas->pou,
				    text + head, wanted.span.len - head);
	}
	g_free(whole);
	return edit;
}

static bool put_body(LadderFbdView *view, int network, const char *body)
{
	struct wanted wanted = { .pou = view->canvas->pou, .network = network };
	char *whole = text_with(view, &wanted);
	bool good = false;

	if (whole && wanted.found) {
		const gsize head = fbd_heading_len(whole + wanted.span.at, wanted.span.len);

		good = exchange(view, whole, wanted.span.at + head, wanted.span.len - head, body);
	}
	g_free(whole);
	return good;
}

bool fbd_put(LadderFbdView *view, struct fbd_edit *edit, int network, bool good, const char *name)
{
	const int made = edit && good ? fbd_edit_made(edit) : -1;
	const struct fbd_pos before = view->cursor;
	char *text = edit && good ? fbd_edit_text(edit) : NULL;

	if (edit && !good)
		canvas_tell(LADDER_CANVAS(view), edit->why ? _(edit->why) : "");
	fbd_edit_free(edit);
	if (!text)
		return false;
	ladder_document_begin(view->canvas->document, name, NULL);
	good = put_body(view, network, text);
	ladder_document_end(view->canvas->document);
	free(text);
	if (!good)
		return false;
	fbd_fresh(view);
	if (made >= 0 && network < view->count)
		fbd_go_statement(view, network, made);
	else
		fbd_go(view, before, false);
	return true;
}

/* ---- whole networks ---- */

static bool replace(LadderFbdView *view, gsize at, gsize removed, const char *with, const char *name)
{
	bool good;

	ladder_document_begin(view->canvas->document, name, NULL);
	good = ladder_document_replace(view->canvas->document, at, removed, with, NULL);
	ladder_document_end(view->canvas->document);
	if (!good)
		canvas_tell(LADDER_CANVAS(view), _("The network cannot hold this."));
	fbd_fresh(view);
	return good;
}

bool fbd_put_heading(LadderFbdView *view, int network, const struct fbd_heading *heading, const char *name)
{
	struct wanted wanted = { .pou = view->canvas->pou, .network = network };
	char *whole = text_with(view, &wanted), *text = fbd_heading_text(heading);
	bool good = false;

	if (whole && wanted.found && text)
		good = replace(view, wanted.span.at, fbd_heading_len(whole + wanted.span.at, wanted.span.len), text, name);
	free(text);
	g_free(whole);
	return good;
}

static bool add_network(LadderFbdView *view, bool below, const char *text, const char *name)
{
	const int network = view->cursor.network;
	struct wanted wanted = { .pou = view->canvas->pou, .network = network };
	char *whole = text_with(view, &wanted);
	char *with = g_strdup_printf("%s%s", network < 0 ? "\n" : "", text);
	const gsize at = network < 0 ? wanted.body.at + wanted.body.len :
			 below ? wanted.span.at + wanted.span.len : wanted.span.at;
	const bool good = whole && replace(view, at, 0, with, name);

	if (good)
		fbd_go(view, (struct fbd_pos){ network < 0 ? 0 : below ? network + 1 : network, -1, -1 }, false);
	g_free(with);
	g_free(whole);
	return good;
}

/* The text of the network at the cursor. Caller frees; NULL: there is none. */
static char *network_text(LadderFbdView *view, struct wanted *wanted)
{
	char *whole, *text = NULL;

	*wanted = (struct wanted){ .pou = view->canvas->pou, .network = view->cursor.network };
	whole = text_with(view, wanted);
	if (whole && wanted->found)
		text = g_strndup(whole + wanted->span.at, wanted->span.len);
	g_free(whole);
	return text;
}

static void delete_network(LadderFbdView *view)
{
	const struct fbd_pos at = view->cursor;
	struct wanted wanted;
	char *text = network_text(view, &wanted);

	if (text && replace(view, wanted.span.at, wanted.span.len, "", _(verb_row(VERB_network_delete)->label)))
		fbd_go(view, (struct fbd_pos){ at.network, -1, -1 }, false);
	g_free(text);
}

static void move_network(LadderFbdView *view, bool down)
{
	const int other = view->cursor.network + (down ? 1 : -1);
	struct wanted wanted = { .pou = view->canvas->pou, .network = other }, own;
	char *text, *whole, *with;
	const struct wanted *first, *second;

	if (view->cursor.network < 0 || other < 0 || other >= view->count)
		return;
	text = network_text(view, &own);
	whole = text_with(view, &wanted);
	first = down ? &own : &wanted;
	second = down ? &wanted : &own;
	with = g_strdup_printf("%.*s%.*s%.*s", (int)second->span.len, whole + second->span.at,
		(int)(second->span.at - first->span.at - first->span.len),
		whole + first->span.at + first->span.len, (int)first->span.len, whole + first->span.at);
	if (replace(view, first->span.at, second->span.at + second->span.len - first->span.at, with,
		    _(verb_row(down ? VERB_network_down : VERB_network_up)->label)))
		fbd_go(view, (struct fbd_pos){ other, -1, -1 }, false);
	g_free(with);
	g_free(whole);
	g_free(text);
}

static void switch_network(LadderFbdView *view)
{
	const struct project *project = ladder_document_project(view->canvas->document);
	const struct fbd_pos at = view->cursor;
	struct fbd_heading heading;

	if (at.network < 0)
		return;
	heading = fbd_lines_heading(project, fbd_pou(view), at.network);
	heading.off = !heading.off;
	if (fbd_put_heading(view, at.network, &heading, _(verb_row(VERB_network_off)->label)))
		fbd_go(view, at, false);
}

/* ---- boxes and pins ---- */

/* The first output of the box at a place; FBD_NOWHERE: it has none. */
static struct fbd_pos output_of(LadderFbdView *view, struct fbd_pos at)
{
	const struct fbd_box *box = fbd_box_at(view, at);
	const struct fbd_graph *graph;
	struct fbd_pos named = FBD_NOWHERE;

	if (!box)
		return FBD_NOWHERE;
	graph = fbd_graph_of(view, at.network);
	for (at.pin = box->first_pin; at.pin < box->first_pin + box->pins; at.pin++) {
		if (!graph->pin[at.pin].output)
			continue;
		if (strcmp(graph->pin[at.pin].name, "ENO") != 0)
			return at;
		named = at;
	}
	return named;
}

bool fbd_add_word(LadderFbdView *view, const char *word, const char *instance)
{
	const struct fbd_pos at = view->cursor, from = output_of(view, at);
	const struct fbd_pin *pin = fbd_pin_at(view, at);
	struct fbd_edit *edit = fbd_begin(view, at.network);
	struct fbd_spot spot;
	bool good;

	if (!edit) {
		canvas_tell(LADDER_CANVAS(view), _("Add a network first."));
		return false;
	}
	if (pin && !pin->output) {
		spot = fbd_spot_of(view, at);
		good = fbd_edit_insert(edit, &spot, word, instance);
	} else if (pin || from.network >= 0) {
		spot = fbd_spot_of(view, pin ? at : from);
		good = fbd_edit_append(edit, &spot, word, instance);
	} else {
		good = fbd_edit_add(edit, fbd_edit_statements(edit) - 1, word, instance);
	}
	return fbd_put(view, edit, at.network, good, _("Add a box"));
}

bool fbd_add_block(LadderFbdView *view, const struct word_row *row, const char *instance)
{
	LadderDocument *document = view->canvas->document;
	const struct entry_place place = { .project = ladder_document_project(document),
					   .pou = view->canvas->pou };
	char name[LIMIT_NAME + 1], *type = g_strdup(row->word);
	bool good;

	if (instance)
		g_strlcpy(name, instance, sizeof(name));
	else
		entry_fresh_name(&place, NULL, entry_family_base(row), name, sizeof(name));
	ladder_document_begin(document, _("Add a box"), NULL);
	good = ladder_document_declare(document, view->canvas->pou, name, type, NULL, NULL);
	fbd_fresh(view);
	good = good && fbd_add_word(view, type, name);
	ladder_document_end(document);
	g_free(type);
	return good;
}

bool fbd_join(LadderFbdView *view, struct fbd_pos a, struct fbd_pos b)
{
	const struct fbd_pin *pin = fbd_pin_at(view, a);
	const bool swapped = pin && !pin->output;
	struct fbd_edit *edit;
	struct fbd_spot from, to;

	if (a.network != b.network || !fbd_pin_at(view, a) || !fbd_pin_at(view, b)) {
		canvas_tell(LADDER_CANVAS(view), a.network != b.network ?
			    _("A wire stays in its network. Use a variable between networks.") :
			    _("A wire leads from an output to an input."));
		return false;
	}
	from = fbd_spot_of(view, swapped ? b : a);
	to = fbd_spot_of(view, swapped ? a : b);
	edit = fbd_begin(view, a.network);
	return edit && fbd_put(view, edit, a.network, fbd_edit_join(edit, &from, &to), _("Connect pins"));
}

void fbd_move_box(LadderFbdView *view, struct fbd_pos at, graphene_point_t corner)
{
	const struct fbd_strip *strip = &view->strip[at.network];
	const struct fbd_spot spot = fbd_spot_of(view, (struct fbd_pos){ at.network, at.box, -1 });
	struct fbd_edit *edit;
	int column, row;

	fbd_layout_hint(strip->layout, at.box, corner.x, corner.y - strip->y, &column, &row);
	edit = fbd_begin(view, at.network);
	if (edit)
		fbd_put(view, edit, at.network,
			fbd_edit_place(edit, &spot, CLAMP(column, 1, 255), CLAMP(row, 1, 255)), _("Move a box"));
}

static void unplace(LadderFbdView *view)
{
	struct fbd_edit *edit = fbd_begin(view, view->cursor.network);
	const struct fbd_spot spot = fbd_spot_of(view, (struct fbd_pos){ view->cursor.network, view->cursor.box, -1 });

	if (edit)
		fbd_put(view, edit, view->cursor.network, fbd_edit_place(edit, &spot, 0, 0),
			_(verb_row(VERB_box_unplace)->label));
}

/* An edit of the pin at the cursor, which keeps the cursor there. */
static void edit_pin(LadderFbdView *view, bool (*change)(struct fbd_edit *edit, const struct fbd_spot *spot),
		     enum verb verb)
{
	const struct fbd_pos at = view->cursor;
	const struct fbd_spot spot = at.network < 0 ? (struct fbd_spot){ .statement = -1 } :
				     fbd_spot_of(view, at);
	struct fbd_edit *edit = at.network < 0 ? NULL : fbd_begin(view, at.network);
	const int boxes = at.network < 0 ? 0 : fbd_graph_of(view, at.network)->box_count;

	if (edit && fbd_put(view, edit, at.network, change(edit, &spot), _(verb_row(verb)->label)) &&
	    at.network < view->count && fbd_graph_of(view, at.network)->box_count == boxes)
		fbd_go(view, at, false);
}

static void order(LadderFbdView *view, bool down)
{
	const struct fbd_pos at = view->cursor;
	struct fbd_edit *edit = at.box >= 0 ? fbd_begin(view, at.network) : NULL;

	if (edit)
		fbd_put(view, edit, at.network, fbd_edit_move(edit, fbd_spot_of(view, at).statement, down),
			_(verb_row(down ? VERB_box_later : VERB_box_earlier)->label));
}

/* ---- deleting and the clipboard ---- */

static void delete(LadderFbdView *view)
{
	const struct fbd_pos at = view->cursor;
	GArray *spots;
	struct fbd_edit *edit;

	if (at.network < 0)
		return;
	if (at.pin >= 0) {
		edit_pin(view, fbd_edit_clear, VERB_delete);
		return;
	}
	spots = fbd_selection(view);
	if (!spots->len) {
		delete_network(view);
	} else {
		edit = fbd_begin(view, at.network);
		if (edit && fbd_put(view, edit, at.network,
				    fbd_edit_remove(edit, (const struct fbd_spot *)(void *)spots->data,
						    (int)spots->len), _(verb_row(VERB_delete)->label)))
			fbd_go(view, (struct fbd_pos){ at.network, at.box, -1 }, false);
	}
	g_array_unref(spots);
}

/* What is selected as lines; of a heading its network. Caller frees; NULL: nothing. */
static char *selected_text(LadderFbdView *view)
{
	GArray *spots = fbd_selection(view);
	struct fbd_edit *edit = spots->len ? fbd_begin(view, view->cursor.network) : NULL;
	char *lines = edit ? fbd_edit_copy(edit, (const struct fbd_spot *)(void *)spots->data, (int)spots->len) : NULL;
	char *text = lines ? g_strdup(lines) : NULL;
	struct wanted wanted;

	if (!spots->len && view->cursor.network >= 0)
		text = network_text(view, &wanted);
	free(lines);
	fbd_edit_free(edit);
	g_array_unref(spots);
	return text;
}

static bool copy(LadderFbdView *view)
{
	char *text = view->cursor.network >= 0 ? selected_text(view) : NULL;

	if (text)
		gdk_clipboard_set_text(gtk_widget_get_clipboard(GTK_WIDGET(view)), text);
	else
		canvas_tell(LADDER_CANVAS(view), _("There is nothing to copy here."));
	g_free(text);
	return text != NULL;
}

/* Declares a new instance for each block of @text that the POU calls already. The text with their names; the
 * caller frees. @told: gets what was declared. */
static char *with_instances(LadderFbdView *view, const char *text, GString *told)
{
	LadderDocument *document = view->canvas->document;
	char name[LIMIT_NAME + 1], fresh[LIMIT_NAME + 1], stem[LIMIT_NAME + 1];
	char *out = g_strdup(text);
	const char *type;

	while (fbd_instance_again(ladder_document_project(document), view->canvas->pou, out, name, &type)) {
		const struct entry_place place = { .project = ladder_document_project(document),
						   .pou = view->canvas->pou };
		char *word = g_strdup(type), *renamed;

		fbd_instance_stem(name, stem);
		entry_fresh_name(&place, NULL, stem, fresh, sizeof(fresh));
		renamed = fbd_name_replaced(out, name, fresh);
		if (!renamed || strcmp(renamed, out) == 0) { /* it stays as it is */
			free(renamed);
			g_free(word);
			break;
		}
		g_free(out);
		out = g_strdup(renamed);
		free(renamed);
		if (ladder_document_declare(document, view->canvas->pou, fresh, word, NULL, NULL))
			g_string_append_printf(told, "%s%s : %s", told->len ? ", " : "", fresh, word);
		g_free(word);
	}
	return out;
}

static bool put_as_is(LadderFbdView *view, const char *text, const char *name)
{
	const int network = view->cursor.network;
	struct fbd_edit *edit;
	bool good;
	int behind;

	if (fbd_is_network(text)) {
		char *whole = g_strdup_printf("%s%s", text, g_str_has_suffix(text, "\n") ? "" : "\n");

		good = add_network(view, true, whole, name);
		g_free(whole);
		return good;
	}
	edit = fbd_begin(view, network);
	if (!edit)
		return false;
	behind = view->cursor.box >= 0 ? fbd_spot_of(view, view->cursor).statement :
					 fbd_edit_statements(edit) - 1;
	return fbd_put(view, edit, network, fbd_edit_paste(edit, behind, text), name);
}

static void put_text(LadderFbdView *view, const char *text, const char *name)
{
	GString *told = g_string_new(NULL);
	char *with;

	ladder_document_begin(view->canvas->document, name, NULL);
	with = with_instances(view, text, told);
	fbd_fresh(view);
	if (put_as_is(view, with, name)) {
		ladder_document_end(view->canvas->document);
	} else { /* the instances are not needed */
		ladder_document_cancel(view->canvas->document);
		g_string_truncate(told, 0);
	}
	if (told->len) {
		char *line = g_strdup_printf(_("New instances: %s"), told->str);

		canvas_tell(LADDER_CANVAS(view), line);
		g_free(line);
	}
	g_string_free(told, TRUE);
	g_free(with);
}

static void text_came(GObject *clipboard, GAsyncResult *result, gpointer data)
{
	LadderFbdView *view = data;
	char *text = gdk_clipboard_read_text_finish(GDK_CLIPBOARD(clipboard), result, NULL);

	if (text && gtk_widget_get_root(GTK_WIDGET(view)) && !canvas_is_fixed(LADDER_CANVAS(view))) {
		fbd_fresh(view);
		put_text(view, text, _(verb_row(VERB_paste)->label));
	}
	g_free(text);
	g_object_unref(view);
}

static void duplicate(LadderFbdView *view)
{
	char *text = view->cursor.network >= 0 ? selected_text(view) : NULL;

	if (text)
		put_text(view, text, _(verb_row(VERB_network_duplicate)->label));
	g_free(text);
}

/* ---- linking by keys ---- */

static void link_here(LadderFbdView *view)
{
	const struct fbd_pos from = view->link;

	if (!fbd_pin_at(view, view->cursor)) {
		canvas_tell(LADDER_CANVAS(view), _("Put the cursor on a pin first."));
		return;
	}
	if (from.network < 0 || fbd_is_same(from, view->cursor)) {
		view->link = fbd_is_same(from, view->cursor) ? FBD_NOWHERE : view->cursor;
		canvas_tell(LADDER_CANVAS(view), view->link.network < 0 ? "" :
			    _("Now the other end of the wire: put the cursor there and do the same."));
		gtk_widget_queue_draw(GTK_WIDGET(view));
		return;
	}
	view->link = FBD_NOWHERE;
	fbd_join(view, from, view->cursor);
}

bool fbd_edit_do(LadderFbdView *view, enum verb verb)
{
	switch ((int)verb) {
	case VERB_delete: delete(view); break;
	case VERB_copy: copy(view); break;
	case VERB_cut:
		if (copy(view))
			delete(view);
		break;
	case VERB_paste:
		gdk_clipboard_read_text_async(gtk_widget_get_clipboard(GTK_WIDGET(view)), NULL, text_came,
					      g_object_ref(view));
		break;
	case VERB_network_below: case VERB_network_above:
		add_network(view, verb == VERB_network_below, "NETWORK\n", _(verb_row(verb)->label));
		break;
	case VERB_network_delete: delete_network(view); break;
	case VERB_network_duplicate: duplicate(view); break;
	case VERB_network_up: case VERB_network_down: move_network(view, verb == VERB_network_down); break;
	case VERB_network_off: switch_network(view); break;
	case VERB_pin_negate: edit_pin(view, fbd_edit_negate, verb); break;
	case VERB_pin_add: edit_pin(view, fbd_edit_add_input, verb); break;
	case VERB_pin_remove: edit_pin(view, fbd_edit_drop_input, verb); break;
	case VERB_pin_link: link_here(view); break;
	case VERB_box_earlier: case VERB_box_later: order(view, verb == VERB_box_later); break;
	case VERB_box_unplace: unplace(view); break;
	default: return false;
	}
	return true;
}
