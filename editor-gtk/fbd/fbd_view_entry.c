/* SPDX-License-Identifier: MIT
 *
 * fbd_view_entry - the entry at the cursor of a network: what stands at a pin, a box to add, names, headings;
 * and its candidates.
 */
#include "editor-gtk/fbd/fbd_view_inside.h"

#include "editor-gtk/document/entry_outcome.h"
#include "editor-gtk/edit/entry_operand.h"
#include "editor-gtk/kit/comment_text.h"
#include "editor-gtk/kit/entry_popup.h"

#include "engine/base/name.h"

#include <string.h>

#define CANDIDATES 40

/* The open question; it lives until the next one. */
struct asked {
	LadderFbdView *view;
	enum fbd_asked what;
	struct fbd_pos at;
};

static struct entry_place place_of(LadderFbdView *view, bool output, bool box)
{
	return (struct entry_place){
		.project = ladder_document_project(view->canvas->document), .pou = view->canvas->pou,
		.output = output, .box = box, .xref = canvas_uses(LADDER_CANVAS(view)),
	};
}

/* ---- what fits at a pin ---- */

static bool stores(const struct fbd_box *box)
{
	return box->kind == FBD_STORE || box->kind == FBD_SET || box->kind == FBD_RESET;
}

/* What fits at a place; an output is written. */
static struct entry_fit fit_of(LadderFbdView *view, struct fbd_pos at, bool write)
{
	const struct fbd_box *box = fbd_box_at(view, at);
	const struct fbd_pin *pin = fbd_pin_at(view, at);
	const struct entry_place place = place_of(view, write, false);
	struct entry_target target = { .means = MEANS_NOTHING };
	struct entry_fit any = { .type = IEC_NONE, .word = WORD_COUNT, .classes = UINT16_MAX, .write = write };

	if (!box || box->kind == FBD_SET || box->kind == FBD_RESET || box->kind == FBD_JUMP ||
	    box->kind == FBD_RETURN || box->kind == FBD_STOP || box->kind == FBD_TRIGGER ||
	    (pin && (strcmp(pin->name, "EN") == 0 || strcmp(pin->name, "ENO") == 0)))
		return entry_fit_bool(write);
	if (stores(box) && !write && box->target)
		entry_target_find(&place, box->target, strlen(box->target), &target);
	if (target.means == MEANS_VALUE)
		return entry_fit_type(target.type, false);
	if (pin && pin->declared && pin->declared->type != IEC_NONE && box->kind == FBD_BLOCK)
		return entry_fit_type(pin->declared->type, write);
	if (pin && pin->declared && box->row && !pin->output)
		return entry_fit_pin(box->row, pin->declared, IEC_NONE, write);
	if (box->row && box->kind != FBD_BLOCK && write)
		return entry_fit_result(box->row, IEC_NONE);
	return any;
}

static bool is_wire(LadderFbdView *view, int network, const char *text)
{
	const struct fbd_graph *graph = fbd_graph_of(view, network);

	for (int i = 0; i < graph->wire_count; i++)
		if (graph->wire[i].name && name_equal(graph->wire[i].name, text))
			return true;
	return false;
}

/* Is it a value of more than one name or constant? */
static bool is_expression(const char *text)
{
	struct fbd_net net;
	const struct fbd_node *node;
	bool more;

	fbd_net_init(&net);
	node = fbd_net_value(&net, text, strlen(text));
	more = node && node->kind != FBD_NODE_OPERAND;
	fbd_net_free(&net);
	return more;
}

/* Reads what is typed at a pin. @entry: gets its declarations, or why it is wrong. The text for the file; NULL:
 * it is wrong. Caller frees. */
static char *value_of(LadderFbdView *view, struct fbd_pos at, const char *line, bool write, struct entry *entry)
{
	const struct entry_place place = place_of(view, write, false);
	const struct entry_fit fit = fit_of(view, at, write);
	struct entry_target *target;
	char literal[ENTRY_TEXT] = "", *text = NULL;
	bool fits = true;

	memset(entry, 0, sizeof(*entry));
	if (!line[0] || is_wire(view, at.network, line) || is_expression(line))
		return g_strdup(line);
	if (!write && entry_literal(line, strlen(line), literal, sizeof(literal), &fits) && fits)
		return g_strdup(literal);
	target = g_new0(struct entry_target, 1);
	if (entry_operand(&place, line, strlen(line), &fit, target, entry))
		text = g_strdup(target->text);
	g_free(target);
	return text;
}

/* ---- candidates ---- */

static void add_row(LadderFbdView *view, const struct entry_candidate *one, const char *line)
{
	struct entry_popup_row row = {
		.text = (char *)one->text, .address = (char *)one->address, .note = (char *)one->note,
		.kind = (char *)_(entry_kind_text(one->kind)), .line = (char *)line,
		.marked = one->kind == ENTRY_NEW,
	};

	ladder_entry_popup_add(LADDER_ENTRY_POPUP(view->canvas->entry), &row);
}

/* Names for a line, as in the entry of a rung behind @head; without words of elements. */
static void offer_names(LadderFbdView *view, int network, const char *head, const char *line, gsize cursor)
{
	const struct entry_place place = place_of(view, strcmp(head, "OUT ") == 0, false);
	struct entry_candidate *found = g_new(struct entry_candidate, CANDIDATES);
	char *part = g_strdup_printf("%s%s", head, line);
	const gsize skip = strlen(head);
	const int count = entry_candidates(&place, part, skip + cursor, found, CANDIDATES);

	for (int i = 0; i < count; i++)
		if (found[i].kind != ENTRY_WORD && found[i].kind != ENTRY_ROUTINE && found[i].kind != ENTRY_LABEL &&
		    (found[i].kind != ENTRY_NEW || !is_wire(view, network, found[i].text)) && strlen(found[i].line) >= skip)
			add_row(view, &found[i], found[i].line + skip);
	g_free(part);
	g_free(found);
}

/* Where the name before the cursor begins. */
static gsize name_start(const char *line, gsize cursor)
{
	gsize at = cursor;

	while (at > 0 && (g_ascii_isalnum(line[at - 1]) || line[at - 1] == '_' || line[at - 1] & 0x80))
		at--;
	return at;
}

/* @text in place of the name before the cursor, if it begins like that. */
static void offer_text(LadderFbdView *view, const char *line, gsize cursor, const char *text,
		       enum entry_kind kind, const char *note)
{
	const gsize from = name_start(line, cursor);
	struct entry_candidate one = { .kind = kind };
	char *whole;

	if (!name_begins(line + from, cursor - from, text, strlen(text)))
		return;
	g_strlcpy(one.text, text, sizeof(one.text));
	g_strlcpy(one.note, note, sizeof(one.note));
	whole = g_strdup_printf("%.*s%s%s", (int)from, line, text, line + cursor);
	add_row(view, &one, whole);
	g_free(whole);
}

static void offer_wires(LadderFbdView *view, int network, const char *line, gsize cursor)
{
	const struct fbd_graph *graph = fbd_graph_of(view, network);

	for (int i = 0; i < graph->wire_count; i++)
		if (graph->wire[i].name)
			offer_text(view, line, cursor, graph->wire[i].name, ENTRY_VARIABLE, _("wire"));
}

/* The words that a value of a network may have besides functions. @box: as boxes, without a parenthesis. */
static void offer_fbd_words(LadderFbdView *view, const char *line, gsize cursor, bool box)
{
	static const struct { const char *word, *note; } words[] = {
		{ "R_EDGE(", N_("TRUE for one scan when the value becomes TRUE") },
		{ "F_EDGE(", N_("TRUE for one scan when the value becomes FALSE") },
		{ "PREVIOUS(", N_("the value of a wire in the scan before") },
	};
	char text[16];

	for (gsize i = 0; name_start(line, cursor) < cursor && i < G_N_ELEMENTS(words) - box; i++) {
		g_strlcpy(text, words[i].word, sizeof(text));
		if (box)
			text[strlen(text) - 1] = '\0';
		offer_text(view, line, cursor, text, ENTRY_WORD, _(words[i].note));
	}
}

/* What a value of a network is made of besides variables and functions. */
static void offer_value(LadderFbdView *view, int network, const char *line, gsize cursor)
{
	offer_wires(view, network, line, cursor);
	offer_fbd_words(view, line, cursor, false);
}

/* Words of boxes, and names. */
static void offer_boxes(LadderFbdView *view, const char *line, gsize cursor)
{
	const struct entry_place place = place_of(view, false, true);
	struct entry_candidate *found = g_new(struct entry_candidate, CANDIDATES);
	const int count = entry_candidates(&place, line, cursor, found, CANDIDATES);

	for (int i = 0; i < count; i++)
		if (found[i].kind != ENTRY_NEW && found[i].kind != ENTRY_LABEL)
			add_row(view, &found[i], found[i].text);
	g_free(found);
}

static void offer_labels(LadderFbdView *view, const char *line)
{
	const struct project *project = ladder_document_project(view->canvas->document);
	const struct pou *pou = fbd_pou(view);
	struct entry_candidate one = { .kind = ENTRY_LABEL };

	for (int i = 0; i < fbd_lines_count(pou); i++) {
		const char *label = fbd_lines_heading(project, pou, i).label;

		if (!label[0] || !name_begins(line, strlen(line), label, strlen(label)))
			continue;
		g_strlcpy(one.text, label, sizeof(one.text));
		add_row(view, &one, one.text);
	}
}

static void offer(const struct asked *asked, const char *line, gsize cursor)
{
	LadderFbdView *view = asked->view;
	const struct fbd_box *box = fbd_box_at(view, asked->at);
	const struct fbd_pin *pin = fbd_pin_at(view, asked->at);

	if (asked->what == FBD_ASK_TITLE || asked->what == FBD_ASK_LABEL || asked->what == FBD_ASK_COMMENT)
		return;
	if (asked->what == FBD_ASK_ADD && strpbrk(line, ":(=")) { /* a whole line */
		offer_value(view, asked->at.network, line, cursor);
		offer_boxes(view, line, cursor);
	} else if (asked->what == FBD_ASK_ADD || asked->what == FBD_ASK_INSERT) {
		offer_fbd_words(view, line, cursor, true);
		offer_boxes(view, line, cursor);
	} else if (asked->what == FBD_ASK_STORE || (pin && pin->output) || (box && stores(box) && !pin)) {
		offer_names(view, asked->at.network, "OUT ", line, cursor);
	} else if (pin || (box && box->kind == FBD_VALUE)) {
		offer_value(view, asked->at.network, line, cursor);
		offer_names(view, asked->at.network, "[", line, cursor);
	} else if (box && box->kind == FBD_JUMP) {
		offer_labels(view, line);
	} else if (box) {
		offer_boxes(view, line, cursor);
	}
}

/* ---- each letter ---- */

/* Is the answer a value or a variable? */
static bool is_value(const struct asked *asked, bool *write)
{
	const struct fbd_box *box = fbd_box_at(asked->view, asked->at);
	const struct fbd_pin *pin = fbd_pin_at(asked->view, asked->at);

	*write = asked->what == FBD_ASK_STORE || (pin && pin->output) || (box && stores(box) && !pin);
	return asked->what == FBD_ASK_STORE ||
	       (asked->what == FBD_ASK_HERE && box && (pin || stores(box) || box->kind == FBD_VALUE));
}

static const struct word_row *box_word(LadderFbdView *view, const char *text);

static char *line_changed(void *context, const char *line, int cursor, bool *good)
{
	const struct asked *asked = context;
	LadderFbdView *view = asked->view;
	struct entry *entry;
	char *told = g_strdup(""), *text;
	bool write;

	if (asked->at.network >= view->count)
		return NULL;
	offer(asked, line, (gsize)(g_utf8_offset_to_pointer(line, cursor) - line));
	if (!line[0] || !is_value(asked, &write) || (!write && box_word(view, line)))
		return told;
	g_free(told);
	entry = g_new(struct entry, 1);
	text = value_of(view, asked->at, line, write, entry);
	told = entry_outcome_tell(view->canvas->document, view->canvas->pou, entry, line, good);
	canvas_blame(LADDER_CANVAS(view), entry);
	*good = text != NULL;
	g_free(text);
	g_free(entry);
	return told;
}

/* ---- a box to add ---- */

/* The row of a function or of a block; NULL: the text is no such word. */
static const struct word_row *box_word(LadderFbdView *view, const char *text)
{
	struct project *project = ladder_document_project(view->canvas->document);
	const enum word word = words_find(&project->words, text, strlen(text));
	const struct word_row *row = words_row(&project->words, word);

	if (strcmp(text, "NOT") == 0 || fbd_operator_word(text))
		return word_row(FN_AND);
	return word != WORD_COUNT && (row->kind == WORD_FN || row->kind == WORD_FB) ? row : NULL;
}

static bool is_edge(const char *text)
{
	return name_equal(text, "R_EDGE") || name_equal(text, "F_EDGE");
}

/* The block that a declared instance is of; NULL: it is none. */
static const struct word_row *instance_word(LadderFbdView *view, const char *text)
{
	const struct entry_place place = place_of(view, false, false);
	struct entry_target *target = g_new0(struct entry_target, 1);
	const struct word_row *row = NULL;

	entry_target_find(&place, text, strlen(text), target);
	if (target->means == MEANS_INSTANCE)
		row = words_row(&place.project->words, target->word);
	g_free(target);
	return row && row->kind == WORD_FB ? row : NULL;
}

/* An output at the cursor, to store. */
static bool has_output(LadderFbdView *view)
{
	const struct fbd_box *box = fbd_box_at(view, view->cursor);
	const struct fbd_pin *pin = fbd_pin_at(view, view->cursor);

	if (pin)
		return pin->output;
	for (int i = 0; box && i < box->pins; i++)
		if (fbd_graph_of(view, view->cursor.network)->pin[box->first_pin + i].output)
			return true;
	return false;
}

/* The output at the cursor, else the first of its box. */
static struct fbd_spot output_spot(LadderFbdView *view)
{
	const struct fbd_graph *graph = fbd_graph_of(view, view->cursor.network);
	const struct fbd_box *box = fbd_box_at(view, view->cursor);
	struct fbd_pos at = view->cursor;

	for (int i = 0; at.pin < 0 && i < box->pins; i++)
		if (graph->pin[box->first_pin + i].output &&
		    strcmp(graph->pin[box->first_pin + i].name, "ENO") != 0)
			at.pin = box->first_pin + i;
	return fbd_spot_of(view, at);
}

/* The output at the cursor is stored; a new variable is declared. */
static bool add_store(LadderFbdView *view, enum fbd_line_kind kind, const char *line)
{
	const int network = view->cursor.network;
	const bool leaves = kind == FBD_LINE_JUMP || kind == FBD_LINE_RETURN || kind == FBD_LINE_STOP;
	struct entry *entry = g_new(struct entry, 1);
	char *text = leaves ? g_strdup(line) : value_of(view, view->cursor, line, true, entry);
	struct fbd_edit *edit = text && has_output(view) ? fbd_begin(view, network) : NULL;
	struct fbd_spot spot;
	bool good = false;

	if (leaves)
		memset(entry, 0, sizeof(*entry));
	if (edit) {
		spot = output_spot(view);
		ladder_document_begin(view->canvas->document, _("Store a value"), NULL);
		good = fbd_put(view, edit, network, fbd_edit_store(edit, &spot, kind, text), "") &&
		       entry_outcome_declare(view->canvas->document, view->canvas->pou, entry);
		ladder_document_end(view->canvas->document);
	} else {
		canvas_tell(LADDER_CANVAS(view), !has_output(view) ?
			    _("Select a box or an output first: its value is stored.") : entry->why ? _(entry->why) : "");
	}
	g_free(text);
	g_free(entry);
	return good;
}

static bool add_line(LadderFbdView *view, const char *line)
{
	const int network = view->cursor.network;
	struct fbd_edit *edit = fbd_begin(view, network);
	const int behind = !edit ? -1 : view->cursor.box >= 0 ? fbd_spot_of(view, view->cursor).statement :
			   fbd_edit_statements(edit) - 1;

	return edit && fbd_put(view, edit, network, fbd_edit_line(edit, behind, line), _("Add a box"));
}

/* `Delay TON`, `TON Delay`, `Delay : TON`, `S Horn`, `JMP Fill`. */
static bool add_two(LadderFbdView *view, const char *a, const char *b)
{
	const struct word_row *first = box_word(view, a), *second = box_word(view, b);

	if (name_equal(a, "S") || name_equal(a, "R"))
		return add_store(view, name_equal(a, "S") ? FBD_LINE_SET : FBD_LINE_RESET, b);
	if (name_equal(a, "JMP"))
		return has_output(view) ? add_store(view, FBD_LINE_JUMP, b) : false;
	if (first && first->kind == WORD_FB && !second)
		return instance_word(view, b) ? fbd_add_word(view, a, b) : fbd_add_block(view, first, b);
	if (second && second->kind == WORD_FB && !first)
		return instance_word(view, a) ? fbd_add_word(view, b, a) : fbd_add_block(view, second, a);
	return false;
}

/* In capitals, as in a ladder: a variable may have the name Stop. */
static enum fbd_line_kind leaving_word(const char *text)
{
	return !strcmp(text, "RETURN") ? FBD_LINE_RETURN : !strcmp(text, "STOP") ? FBD_LINE_STOP : FBD_LINE_OTHER;
}

static bool add_one(LadderFbdView *view, const char *text)
{
	const enum fbd_line_kind leaving = leaving_word(text);
	const struct word_row *row = box_word(view, text), *of = row ? NULL : instance_word(view, text);

	if (leaving != FBD_LINE_OTHER)
		return has_output(view) ? add_store(view, leaving, text) : add_line(view, text);
	if (of)
		return fbd_add_word(view, of->word, text);
	if (row && row->kind == WORD_FB)
		return fbd_add_block(view, row, NULL);
	if (row || is_edge(text))
		return fbd_add_word(view, text, NULL);
	if (has_output(view))
		return add_store(view, FBD_LINE_ASSIGN, text);
	canvas_tell(LADDER_CANVAS(view), _("This is no box. Type the name of a function or block, or target := value."));
	return false;
}

static bool take_add(LadderFbdView *view, const char *line)
{
	char **word = g_strsplit_set(line, " :", -1);
	const char *two[3] = { NULL, NULL, NULL };
	int count = 0;
	bool good, plain = !strstr(line, ":=") && !strpbrk(line, "()=");

	for (char **at = word; *at; at++)
		if (**at && count < 3)
			two[count++] = *at;
	good = plain && count == 2 && add_two(view, two[0], two[1]);
	if (!good)
		good = count == 1 && (plain || fbd_operator_word(line)) ? add_one(view, line) : add_line(view, line);
	g_strfreev(word);
	return good;
}

/* ---- Enter at a part ---- */

static bool take_value(const struct asked *asked, const char *line, bool write)
{
	LadderFbdView *view = asked->view;
	const struct fbd_pin *pin = fbd_pin_at(view, asked->at);
	struct entry *entry = g_new(struct entry, 1);
	char *text = value_of(view, asked->at, line, write, entry);
	struct fbd_spot spot = fbd_spot_of(view, asked->at);
	struct fbd_edit *edit = text ? fbd_begin(view, asked->at.network) : NULL;
	const int boxes = fbd_graph_of(view, asked->at.network)->box_count;
	bool good = false;

	if (!pin)
		spot.output = write;
	if (edit) {
		ladder_document_begin(view->canvas->document, _("Change what is at a pin"), NULL);
		good = fbd_put(view, edit, asked->at.network, fbd_edit_operand(edit, &spot, text), "") &&
		       entry_outcome_declare(view->canvas->document, view->canvas->pou, entry);
		ladder_document_end(view->canvas->document);
		fbd_fresh(view);
		if (good && asked->at.network < view->count &&
		    fbd_graph_of(view, asked->at.network)->box_count == boxes)
			fbd_go(view, asked->at, false);
	}
	g_free(text);
	g_free(entry);
	return good;
}

static bool take_type(const struct asked *asked, const char *line)
{
	LadderFbdView *view = asked->view;
	const struct fbd_box *box = fbd_box_at(view, asked->at);
	const struct fbd_spot spot = fbd_spot_of(view, asked->at);
	char *type = box->kind == FBD_BLOCK && box->row && !instance_word(view, line) ? g_strdup(box->row->word) : NULL;
	struct fbd_edit *edit;
	bool good = true;

	if (box->kind != FBD_BLOCK && !box_word(view, line)) {
		canvas_tell(LADDER_CANVAS(view), _("This is no function."));
		return false;
	}
	ladder_document_begin(view->canvas->document, _("Change a box"), NULL);
	if (type)
		good = ladder_document_declare(view->canvas->document, view->canvas->pou, line, type, NULL, NULL);
	fbd_fresh(view);
	edit = good ? fbd_begin(view, asked->at.network) : NULL;
	good = edit && fbd_put(view, edit, asked->at.network, fbd_edit_type(edit, &spot, line), "");
	ladder_document_end(view->canvas->document);
	g_free(type);
	if (good)
		fbd_go(view, asked->at, false);
	return good;
}

static bool take_heading(const struct asked *asked, const char *line)
{
	LadderFbdView *view = asked->view;
	const struct project *project = ladder_document_project(view->canvas->document);
	struct fbd_heading heading = fbd_lines_heading(project, fbd_pou(view), asked->at.network);
	char *comment = *line ? g_strdup_printf("// %s", line) : g_strdup("");
	bool good;

	if (asked->what == FBD_ASK_LABEL)
		heading.label = line;
	else if (asked->what == FBD_ASK_TITLE)
		heading.title = line;
	else
		heading.comment = comment;
	good = fbd_put_heading(view, asked->at.network, &heading, _(verb_row(asked->what == FBD_ASK_LABEL ?
		VERB_network_label : asked->what == FBD_ASK_TITLE ? VERB_network_title : VERB_network_comment)->label));
	g_free(comment);
	if (good)
		fbd_go(view, asked->at, false);
	return good;
}

/* Enter at a pin: a word of a box puts that box before the input, or behind the output. */
static bool take_here(const struct asked *asked, const char *line)
{
	LadderFbdView *view = asked->view;
	const struct fbd_box *box = fbd_box_at(view, asked->at);
	const struct word_row *row = box_word(view, line);
	struct fbd_edit *edit;
	struct fbd_spot spot;
	bool write;

	if (box && asked->at.pin >= 0 && (row || is_edge(line)))
		return row && row->kind == WORD_FB ? fbd_add_block(view, row, NULL) : fbd_add_word(view, line, NULL);
	if (is_value(asked, &write))
		return take_value(asked, line, write);
	if (box && box->kind == FBD_JUMP) {
		spot = fbd_spot_of(view, asked->at);
		edit = fbd_begin(view, asked->at.network);
		return edit && fbd_put(view, edit, asked->at.network, fbd_edit_operand(edit, &spot, line),
				       _("Change a box"));
	}
	return box && box->kind != FBD_RETURN && box->kind != FBD_STOP ? take_type(asked, line) : take_add(view, line);
}

static bool line_taken(void *context, const char *text)
{
	const struct asked asked = *(struct asked *)context;
	LadderFbdView *view = asked.view;
	char *line = g_strstrip(g_strdup(text));
	bool good = false;

	fbd_fresh(view);
	if (asked.at.network >= 0 && asked.at.network < view->count)
		switch (asked.what) {
		case FBD_ASK_HERE: good = take_here(&asked, line); break;
		case FBD_ASK_ADD: case FBD_ASK_INSERT: good = take_add(view, line); break;
		case FBD_ASK_STORE: good = add_store(view, FBD_LINE_ASSIGN, line); break;
		case FBD_ASK_TITLE: case FBD_ASK_LABEL: case FBD_ASK_COMMENT: good = take_heading(&asked, line); break;
		}
	g_free(line);
	return good;
}

/* ---- asking ---- */

static char *pin_text(LadderFbdView *view, struct fbd_pos at)
{
	const struct fbd_pin *pin = fbd_pin_at(view, at);
	const struct fbd_graph *graph = fbd_graph_of(view, at.network);
	const struct fbd_box *box = fbd_box_at(view, at);
	const char *text = fbd_lines_text(ladder_document_project(view->canvas->document), fbd_pou(view), box->item);

	if (pin->output && pin->operand)
		return g_strdup(pin->operand);
	if (pin->output)
		return g_strdup(pin->wire >= 0 && graph->wire[pin->wire].name ? graph->wire[pin->wire].name : "");
	return pin->len > 0 ? g_strndup(text + pin->at, (gsize)pin->len) : g_strdup("");
}

static char *text_now(const struct asked *asked)
{
	LadderFbdView *view = asked->view;
	const struct project *project = ladder_document_project(view->canvas->document);
	const struct fbd_box *box = fbd_box_at(view, asked->at);
	const struct fbd_heading heading = fbd_lines_heading(project, fbd_pou(view), asked->at.network);

	switch (asked->what) {
	case FBD_ASK_TITLE: return g_strdup(heading.title);
	case FBD_ASK_LABEL: return g_strdup(heading.label);
	case FBD_ASK_COMMENT: return comment_text(heading.comment);
	case FBD_ASK_ADD: case FBD_ASK_INSERT: case FBD_ASK_STORE: return g_strdup("");
	case FBD_ASK_HERE: break;
	}
	if (!box)
		return g_strdup("");
	if (asked->at.pin >= 0)
		return pin_text(view, asked->at);
	return g_strdup(box->kind == FBD_BLOCK ? box->instance : box->target ? box->target : box->type);
}

static const char *prompt_of(const struct asked *asked)
{
	LadderFbdView *view = asked->view;
	const struct fbd_box *box = fbd_box_at(view, asked->at);
	const struct fbd_pin *pin = fbd_pin_at(view, asked->at);

	switch (asked->what) {
	case FBD_ASK_TITLE: return _("Title of the network");
	case FBD_ASK_LABEL: return _("Label of the network");
	case FBD_ASK_COMMENT: return _("Comment of the network");
	case FBD_ASK_STORE: return _("Store in the variable");
	case FBD_ASK_ADD: return _("A box: AND, TON, Delay TON, S Horn; or target := value");
	case FBD_ASK_INSERT: return _("The box to put into the wire");
	case FBD_ASK_HERE: break;
	}
	if (pin)
		return pin->output ? _("Variable or wire") : _("A value, or a box to put before the pin");
	return !box ? "" : box->kind == FBD_BLOCK ? _("Instance") : box->kind == FBD_JUMP ? _("Label") :
	       stores(box) || box->kind == FBD_VALUE ? _("Variable") : _("Function or operator");
}

void fbd_ask(LadderFbdView *view, enum fbd_asked what, const char *typed)
{
	struct canvas_question question = {
		.typed = typed != NULL, .changed = line_changed, .taken = line_taken, .free = g_free,
	};
	struct asked *asked;
	char *text;

	if (view->canvas->entry || !fbd_pou(view) || canvas_is_fixed(LADDER_CANVAS(view)))
		return;
	if (view->cursor.network < 0) {
		canvas_refuse(LADDER_CANVAS(view), _("A box"), _("Add a network first: press Ins."));
		return;
	}
	if (what == FBD_ASK_HERE && view->cursor.box < 0)
		what = typed ? FBD_ASK_ADD : FBD_ASK_TITLE;
	if (what == FBD_ASK_HERE && typed && view->cursor.pin < 0)
		what = FBD_ASK_ADD;
	asked = g_new0(struct asked, 1);
	*asked = (struct asked){ view, what, view->cursor };
	text = typed ? g_strdup(typed) : text_now(asked);
	question.prompt = prompt_of(asked);
	question.context = asked;
	question.text = text;
	question.spells = what == FBD_ASK_HERE || what == FBD_ASK_ADD || what == FBD_ASK_INSERT || what == FBD_ASK_STORE;
	canvas_ask(LADDER_CANVAS(view), &question);
	g_free(text);
}
