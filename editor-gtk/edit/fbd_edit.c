/* SPDX-License-Identifier: MIT
 *
 * fbd_edit - edits of a network; see fbd_edit.h.
 */
#include "editor-gtk/edit/fbd_edit.h"

#include "editor-gtk/edit/entry_names.h"
#include "editor-gtk/edit/fbd_instances.h"
#include "editor-gtk/kit/i18n.h"
#include "engine/base/lex.h"
#include "engine/base/name.h"
#include "engine/base/sink.h"
#include "engine/model/expr_args.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define NO_MEMORY N_("out of memory")
#define GONE      N_("This box is not in the network any more.")
#define NO_OUTPUT N_("This box has no output.")
#define NO_VALUE  N_("This is not a value: type a name, a constant or an expression.")

/* A box of the edit, or a place in a line. */
struct box_at {
	struct fbd_line *line;
	struct fbd_node *node;    /* NULL: the box at the end of the line        */
};

static bool refuse(struct fbd_edit *edit, const char *why)
{
	edit->why = why;
	return false;
}

static bool finish(struct fbd_edit *edit, const struct fbd_line *line)
{
	edit->made = line;
	return edit->net.arena.failed ? refuse(edit, NO_MEMORY) : true;
}

struct fbd_edit *fbd_edit_new(struct project *project, int pou, const char *text, size_t len)
{
	struct fbd_edit *edit = calloc(1, sizeof(*edit));

	if (!edit)
		return NULL;
	edit->project = project;
	edit->pou = pou;
	fbd_net_init(&edit->net);
	if (fbd_net_read(&edit->net, text, len))
		return edit;
	fbd_edit_free(edit);
	return NULL;
}

void fbd_edit_free(struct fbd_edit *edit)
{
	if (!edit)
		return;
	fbd_net_free(&edit->net);
	free(edit);
}

char *fbd_edit_text(const struct fbd_edit *edit)
{
	return fbd_net_write(&edit->net);
}

/* ---- names ---- */

static struct entry_place entry_place_of(const struct fbd_edit *edit)
{
	return (struct entry_place){ .project = edit->project, .pou = edit->pou };
}

static bool is_declared(const struct fbd_edit *edit, const char *name, size_t len)
{
	const struct entry_place at = entry_place_of(edit);
	const struct pou *pou = &edit->project->pou[edit->pou];
	const uint32_t fold = names_find_any(&edit->project->names, name, len);

	return entry_var_find(&at, name, len, NULL) ||
	       (fold && vars_find(&pou->external, fold) >= 0);
}

/* A plain name that is declared nowhere: a wire, as a target. */
static bool is_wire_name(const struct fbd_edit *edit, const char *name)
{
	struct iec_addr addr;
	const char *why = NULL;

	return strcspn(name, ".[^%# ") == strlen(name) && !is_declared(edit, name, strlen(name)) &&
	       entry_is_name(name, strlen(name)) && !entry_address_parse(name, strlen(name), &addr, &why);
}

static bool gives_wire(const struct fbd_edit *edit, const struct fbd_line *line)
{
	return line->kind == FBD_LINE_ASSIGN && is_wire_name(edit, line->target);
}

/* The head of a path is this name. */
static bool is_of(const char *path, const char *name)
{
	return name_is(name, path, strcspn(path, ".[^ "));
}

/* The name is the head of a path, or that of one in an index of it. */
static bool mentions(const char *path, const char *name)
{
	struct lex lex;
	bool behind_dot = false;

	if (!strchr(path, '['))
		return is_of(path, name);
	lex_init(&lex, path, strlen(path));
	while (lex_next(&lex) != TOKEN_END) {
		if (lex.token.kind == TOKEN_NAME && !behind_dot &&
		    name_is(name, lex.token.text, strcspn(lex.token.text, ".[]^ +-*/,)(")))
			return true;
		behind_dot = lex_is(&lex, ".");
	}
	return false;
}

static bool is_call(const struct fbd_node *node, const char *word)
{
	return node->kind == FBD_NODE_CALL && name_equal(node->text, word) && node->count == 1;
}

static bool is_not(const struct fbd_node *node)
{
	return node->kind == FBD_NODE_INFIX && node->count == 1 && name_equal(node->text, "NOT");
}

/* Does the value read the name? Its value of the scan before is another. */
static bool reads(const struct fbd_node *node, const char *name)
{
	if (!node || is_call(node, "PREVIOUS"))
		return false;
	if (node->kind == FBD_NODE_OPERAND)
		return mentions(node->text, name);
	for (int i = 0; i < node->count; i++)
		if (!node->arg[i].output && reads(node->arg[i].value, name))
			return true;
	return false;
}

/* Is the name anywhere in the value? */
static bool names_it(const struct fbd_node *node, const char *name)
{
	if (!node)
		return false;
	if (node->kind != FBD_NODE_INFIX && mentions(node->text, name))
		return true;
	for (int i = 0; i < node->count; i++)
		if (names_it(node->arg[i].value, name))
			return true;
	return false;
}

static bool is_named(const struct fbd_edit *edit, const char *name)
{
	for (int i = 0; i < edit->net.count; i++) {
		const struct fbd_line *line = edit->net.line[i];

		if ((line->target && is_of(line->target, name)) || names_it(line->value, name) ||
		    (line->kind == FBD_LINE_OTHER && strstr(line->text, name)))
			return true;
	}
	return false;
}

static const char *fresh_wire(struct fbd_edit *edit)
{
	char name[32];

	for (int i = 1; i < LIMIT_VARS; i++) {
		snprintf(name, sizeof(name), "Wire%d", i);
		if (is_wire_name(edit, name) && !is_named(edit, name) &&
		    project_find_pou(edit->project, name, strlen(name)) < 0)
			break;
	}
	return arena_copy(&edit->net.arena, name, strlen(name));
}

/* ---- boxes ---- */

static bool is_place(const struct fbd_node *node)
{
	return node->kind == FBD_NODE_OPERAND || is_call(node, "PREVIOUS");
}

/* NOT of an operand is a circle at the pin. */
static bool is_circle(const struct fbd_node *node)
{
	return is_not(node) && node->arg[0].value && is_place(node->arg[0].value);
}

static bool is_box(const struct fbd_node *node)
{
	return node && node->kind != FBD_NODE_OPERAND && !is_circle(node) && !is_call(node, "PREVIOUS");
}

struct boxes {
	struct fbd_node *node[FBD_MOST_BOXES];
	int count;
};

static void collect(struct fbd_node *node, struct boxes *out)
{
	if (!node)
		return;
	for (int i = 0; i < node->count; i++)
		if (!node->arg[i].output)
			collect(node->arg[i].value, out);
	if (is_box(node) && out->count < FBD_MOST_BOXES)
		out->node[out->count++] = node;
}

static bool has_end(const struct fbd_edit *edit, const struct fbd_line *line)
{
	if (line->kind == FBD_LINE_CALL || line->kind == FBD_LINE_NOTE || line->kind == FBD_LINE_OTHER)
		return false;
	return !gives_wire(edit, line) || !is_box(line->value);
}

/* The line of a statement; -1: none. */
static int line_of(const struct fbd_edit *edit, int statement)
{
	for (int i = 0; i < edit->net.count; i++)
		if (edit->net.line[i]->kind != FBD_LINE_NOTE && statement-- == 0)
			return i;
	return -1;
}

static int index_of(const struct fbd_edit *edit, const struct fbd_line *line)
{
	for (int i = 0; i < edit->net.count; i++)
		if (edit->net.line[i] == line)
			return i;
	return -1;
}

int fbd_edit_statements(const struct fbd_edit *edit)
{
	int count = 0;

	for (int i = 0; i < edit->net.count; i++)
		count += edit->net.line[i]->kind != FBD_LINE_NOTE;
	return count;
}

int fbd_edit_made(const struct fbd_edit *edit)
{
	int statement = 0;

	for (int i = 0; i < edit->net.count; i++) {
		if (edit->net.line[i] == edit->made)
			return edit->made->kind == FBD_LINE_NOTE ? -1 : statement;
		statement += edit->net.line[i]->kind != FBD_LINE_NOTE;
	}
	return -1;
}

static bool find(struct fbd_edit *edit, const struct fbd_spot *spot, struct box_at *out)
{
	const int at = line_of(edit, spot->statement);
	struct boxes boxes = { .count = 0 };

	if (at < 0)
		return refuse(edit, GONE);
	*out = (struct box_at){ .line = edit->net.line[at] };
	collect(out->line->value, &boxes);
	if (spot->box >= 0 && spot->box < boxes.count)
		out->node = boxes.node[spot->box];
	else if (spot->box != boxes.count || !has_end(edit, out->line))
		return refuse(edit, GONE);
	return true;
}

/* Where a value hangs that is or contains @node. */
static struct fbd_node **slot_in(struct fbd_node **slot, const struct fbd_node *node)
{
	struct fbd_node **found = NULL;

	if (*slot == node)
		return slot;
	for (int i = 0; *slot && i < (*slot)->count && !found; i++)
		if ((*slot)->arg[i].value)
			found = slot_in(&(*slot)->arg[i].value, node);
	return found;
}

static struct fbd_node **slot_of(const struct fbd_edit *edit, const struct fbd_node *node,
				 struct fbd_line **line)
{
	for (int i = 0; i < edit->net.count; i++) {
		struct fbd_node **slot = slot_in(&edit->net.line[i]->value, node);

		if (slot) {
			*line = edit->net.line[i];
			return slot;
		}
	}
	return NULL;
}

/* ---- pins ---- */

/* The row of a call; NULL: it is not known. */
static const struct word_row *row_of(struct fbd_edit *edit, const struct fbd_node *node, bool *instance)
{
	const struct entry_place at = entry_place_of(edit);
	struct word_table *words = &edit->project->words;
	struct entry_target target = { .means = MEANS_NOTHING };
	enum word word;

	*instance = false;
	if (node->kind == FBD_NODE_INFIX) {
		const char *name = fbd_operator_word(node->text);

		word = name ? op_function(op_find(name, strlen(name))) : WORD_COUNT;
		if (name && word == WORD_COUNT)
			word = words_find(words, name, strlen(name));
		return word == WORD_COUNT ? NULL : words_row(words, word);
	}
	entry_target_find(&at, node->text, strlen(node->text), &target);
	*instance = target.means == MEANS_INSTANCE;
	word = *instance ? target.word : words_find(words, node->text, strlen(node->text));
	return word == WORD_COUNT ? NULL : words_row(words, word);
}

/* The name of the pin that argument @index has by its place; "": none. True: it is an output. */
static bool pin_by_place(struct fbd_edit *edit, const struct fbd_node *node, int index, char *out, size_t size)
{
	bool instance;
	const struct word_row *row = row_of(edit, node, &instance);
	const struct word_pin *pin = NULL;
	int last = -1;

	out[0] = '\0';
	if (!row)
		return false;
	if (!instance && row->most_inputs) {
		expr_pin_name(row, index, out, size);
		return false;
	}
	for (int i = 0; i <= index; i++)
		pin = pin_next(row, &last);
	snprintf(out, size, "%s", pin ? pin->name : "");
	return pin && pin->dir == PIN_OUT;
}

/* All arguments get the names of their pins. */
static bool name_args(struct fbd_edit *edit, struct fbd_node *node)
{
	char name[LIMIT_NAME + 1];

	for (int i = 0; i < node->count; i++) {
		if (node->arg[i].pin)
			continue;
		node->arg[i].output = pin_by_place(edit, node, i, name, sizeof(name));
		if (!name[0])
			return refuse(edit, N_("The pins of this box are not known."));
		node->arg[i].pin = arena_copy(&edit->net.arena, name, strlen(name));
	}
	return true;
}

static int arg_of(struct fbd_edit *edit, const struct fbd_node *node, const char *pin, bool output)
{
	char name[LIMIT_NAME + 1];

	for (int i = 0; i < node->count; i++) {
		const struct fbd_arg *arg = &node->arg[i];
		bool gives = arg->output;

		if (arg->pin)
			snprintf(name, sizeof(name), "%s", arg->pin);
		else
			gives = pin_by_place(edit, node, i, name, sizeof(name));
		if (gives == output && name_equal(name, pin))
			return i;
	}
	return -1;
}

static bool is_edge(const struct fbd_node *node)
{
	return is_call(node, "R_EDGE") || is_call(node, "F_EDGE");
}

/* What a store has that gets nothing: a box with an open input. */
static struct fbd_node *open_value(struct fbd_edit *edit)
{
	struct fbd_node *node = fbd_node_new(&edit->net, FBD_NODE_CALL, "MOVE");

	return node && fbd_node_push(&edit->net, node, "IN", NULL) ? node : NULL;
}

static bool is_open_value(const struct fbd_node *node)
{
	return node && is_call(node, "MOVE") && !node->arg[0].value;
}

/* Where a box hangs that stands only for an open input, of a store or of NOT; NULL: it is no such box. */
static struct fbd_node **stand_in(struct fbd_line *line, const struct fbd_node *node, bool stored)
{
	struct fbd_node **slot = slot_in(&line->value, node), *parent = line->value;

	if (!is_open_value(node) || !slot)
		return NULL;
	if (slot == &line->value)
		return stored ? slot : NULL;
	while (parent->count == 1 && parent->arg[0].value != node)
		parent = parent->arg[0].value;
	return parent->count == 1 && (parent->kind == FBD_NODE_INFIX || is_edge(parent)) ? slot : NULL;
}

/* Where the value of an input hangs. NULL: refused. */
static struct fbd_node **input_of(struct fbd_edit *edit, const struct box_at *at, const struct fbd_spot *spot)
{
	struct fbd_node *node = at->node, **slot;
	struct fbd_arg *arg;
	int index;

	if (!node)
		return &at->line->value;
	slot = stand_in(at->line, node, !gives_wire(edit, at->line));
	if (slot)
		return slot;
	if (node->kind == FBD_NODE_INFIX || is_edge(node)) {
		if (spot->number >= 0 && spot->number < node->count)
			return &node->arg[spot->number].value;
		refuse(edit, GONE);
		return NULL;
	}
	if (!spot->pin || !spot->pin[0]) {
		refuse(edit, GONE);
		return NULL;
	}
	index = arg_of(edit, node, spot->pin, false);
	if (index >= 0)
		return &node->arg[index].value;
	if (!name_args(edit, node))
		return NULL;
	arg = fbd_node_push(&edit->net, node, arena_copy(&edit->net.arena, spot->pin, strlen(spot->pin)), NULL);
	return arg ? &arg->value : NULL;
}

/* The value of a line: one that must have one has an open box. */
static void fill(struct fbd_edit *edit, struct fbd_line *line)
{
	if (!line->value && (line->kind == FBD_LINE_ASSIGN || line->kind == FBD_LINE_SET ||
			     line->kind == FBD_LINE_RESET))
		line->value = open_value(edit);
	line->changed = true;
}

/* ---- wires ---- */

static struct fbd_node *operand(struct fbd_edit *edit, const char *text)
{
	return fbd_node_new(&edit->net, FBD_NODE_OPERAND, text);
}

/* A new line before @line gives the value at @slot to a wire, which the slot reads then. Returns the new line. */
static struct fbd_line *extract(struct fbd_edit *edit, struct fbd_line *line, struct fbd_node **slot)
{
	struct fbd_line *new = fbd_net_insert(&edit->net, index_of(edit, line), FBD_LINE_ASSIGN);

	if (!new)
		return NULL;
	new->target = fresh_wire(edit);
	new->value = *slot;
	new->gap = line->gap;
	line->gap = false;
	if (slot == &line->value) { /* the hint is that of the box, not of the store behind it */
		new->column = line->column;
		new->row = line->row;
		line->column = line->row = 0;
	}
	line->changed = true;
	*slot = operand(edit, new->target);
	return new;
}

/* The slot becomes empty. A box in it stays, with a line of its own. */
static void detach(struct fbd_edit *edit, struct fbd_line *line, struct fbd_node **slot)
{
	struct boxes boxes = { .count = 0 };

	collect(*slot, &boxes);
	if (boxes.count > 0 && !is_open_value(*slot)) {
		if (is_call(*slot, "PREVIOUS"))
			slot = &(*slot)->arg[0].value;
		extract(edit, line, slot);
	}
	*slot = NULL;
	line->changed = true;
}

/* Puts a value in place of what is there. */
static void replace(struct fbd_edit *edit, struct fbd_line *line, struct fbd_node **slot, struct fbd_node *value)
{
	detach(edit, line, slot);
	*slot = value;
	line->changed = true;
}

/* Every place that reads a wire gets @value, NULL: becomes open. */
static void replace_reads(struct fbd_edit *edit, struct fbd_line *line, struct fbd_node **slot, const char *wire,
			  const char *value)
{
	struct fbd_node *node = *slot;

	if (!node)
		return;
	if (node->kind == FBD_NODE_OPERAND) {
		if (name_equal(node->text, wire)) {
			*slot = value ? fbd_net_value(&edit->net, value, strlen(value)) : NULL;
			line->changed = true;
		}
		return;
	}
	for (int i = 0; i < node->count; i++)
		replace_reads(edit, line, &node->arg[i].value, wire, value);
	if ((is_not(node) || is_call(node, "PREVIOUS")) && !node->arg[0].value)
		*slot = NULL;
}

static void replace_everywhere(struct fbd_edit *edit, const char *wire, const char *value)
{
	for (int i = 0; i < edit->net.count; i++) {
		struct fbd_line *line = edit->net.line[i];

		replace_reads(edit, line, &line->value, wire, value);
		if (line->changed)
			fill(edit, line);
	}
}

/* The names of the wires that a line gives: its target, and those behind =>. */
struct wires {
	const char *name[FBD_MOST_BOXES];
	int count;
};

static void wires_behind(const struct fbd_edit *edit, const struct fbd_node *node, struct wires *out)
{
	for (int i = 0; node && i < node->count; i++) {
		const struct fbd_arg *arg = &node->arg[i];

		if (!arg->output)
			wires_behind(edit, arg->value, out);
		else if (arg->value && is_wire_name(edit, arg->value->text) && out->count < FBD_MOST_BOXES)
			out->name[out->count++] = arg->value->text;
	}
}

static void wires_of(const struct fbd_edit *edit, const struct fbd_line *line, struct wires *out)
{
	out->count = 0;
	if (gives_wire(edit, line))
		out->name[out->count++] = line->target;
	wires_behind(edit, line->value, out);
}

static bool needs(const struct fbd_edit *edit, const struct fbd_line *line, const struct fbd_line *other)
{
	struct wires wires;

	if (line == other || other->kind == FBD_LINE_NOTE)
		return false;
	wires_of(edit, other, &wires);
	for (int i = 0; i < wires.count; i++)
		if (reads(line->value, wires.name[i]))
			return true;
	return false;
}

/* Does line @line need @other, directly or by lines between them? Those in @seen do not. */
static bool needs_by(struct fbd_edit *edit, int line, const struct fbd_line *other, bool *seen)
{
	const struct fbd_line *own = edit->net.line[line];

	if (own == other || needs(edit, own, other))
		return true;
	seen[line] = true;
	for (int i = 0; i < edit->net.count; i++)
		if (!seen[i] && needs(edit, own, edit->net.line[i]) && needs_by(edit, i, other, seen))
			return true;
	return false;
}

static bool needs_any(struct fbd_edit *edit, const struct fbd_line *line, const struct fbd_line *other)
{
	bool *seen = arena_alloc(&edit->net.arena, (size_t)edit->net.count + 1);

	if (!seen)
		return false;
	memset(seen, 0, (size_t)edit->net.count + 1);
	return needs_by(edit, index_of(edit, line), other, seen);
}

/* May line @at come next, when those in @done have come? */
static bool is_ready(struct fbd_edit *edit, int at, const bool *done, const struct fbd_line *first,
		     const struct fbd_line *then)
{
	const struct fbd_line *line = edit->net.line[at];

	for (int i = 0; i < edit->net.count; i++)
		if (!done[i] && i != at &&
		    ((line == then && edit->net.line[i] == first) || needs(edit, line, edit->net.line[i])))
			return false;
	return true;
}

/* Moves lines below those that they need, and @then below @first; comments stay above what they stand above.
 * False: there is a loop; nothing is changed. */
static bool sort(struct fbd_edit *edit, const struct fbd_line *first, const struct fbd_line *then)
{
	const int count = edit->net.count;
	bool *done = arena_alloc(&edit->net.arena, (size_t)count + 1);
	struct fbd_line **order = arena_alloc(&edit->net.arena, ((size_t)count + 1) * sizeof(struct fbd_line *));
	int placed = 0;

	if (!done || !order)
		return refuse(edit, NO_MEMORY);
	memset(done, 0, (size_t)count + 1);
	while (placed < count) {
		int at = 0, begin;

		for (; at < count; at++)
			if (!done[at] && (edit->net.line[at]->kind != FBD_LINE_NOTE || at == count - 1 ) &&
			    is_ready(edit, at, done, first, then))
				break;
		if (at == count)
			return false;
		for (begin = at; begin > 0 && edit->net.line[begin - 1]->kind == FBD_LINE_NOTE && !done[begin - 1];)
			begin--;
		for (; begin <= at; begin++) {
			done[begin] = true;
			order[placed++] = edit->net.line[begin];
		}
	}
	memcpy(edit->net.line, order, (size_t)count * sizeof(*order));
	return true;
}

static bool sorted(struct fbd_edit *edit, const struct fbd_line *line)
{
	if (!sort(edit, NULL, NULL))
		return edit->net.arena.failed ? refuse(edit, NO_MEMORY) :
		       refuse(edit, N_("This closes a loop. Use PREVIOUS( ) for the value of the scan before."));
	return finish(edit, line);
}

/* ---- what an output gives ---- */

/* The variable behind `pin =>`; makes a wire if there is none. */
static const char *named_output(struct fbd_edit *edit, const struct box_at *at, const char *pin)
{
	const int index = arg_of(edit, at->node, pin, true);
	struct fbd_arg *arg = index >= 0 ? &at->node->arg[index] : NULL;

	if (arg && arg->value)
		return arg->value->text;
	if (!name_args(edit, at->node))
		return NULL;
	if (!arg)
		arg = fbd_node_push(&edit->net, at->node,
				    arena_copy(&edit->net.arena, pin, strlen(pin)), NULL);
	if (!arg)
		return NULL;
	arg->output = true;
	arg->value = operand(edit, fresh_wire(edit));
	at->line->changed = true;
	return arg->value ? arg->value->text : NULL;
}

/* The wire that is the result of a box; makes one. */
static const char *result_of(struct fbd_edit *edit, struct box_at *at)
{
	struct fbd_node **slot = slot_of(edit, at->node, &at->line);

	if (at->line->kind == FBD_LINE_CALL && *slot == at->line->value) {
		at->line->kind = FBD_LINE_ASSIGN;
		at->line->target = fresh_wire(edit);
		at->line->changed = true;
	} else if (*slot != at->line->value || !gives_wire(edit, at->line)) {
		at->line = extract(edit, at->line, slot);
	}
	return at->line ? at->line->target : NULL;
}

static const char *first_output(struct fbd_edit *edit, const struct fbd_node *node)
{
	bool instance;
	const struct word_row *row = row_of(edit, node, &instance);

	for (int i = 0; row && i < row->pin_count; i++)
		if (row->pin[i].dir == PIN_OUT)
			return row->pin[i].name;
	return NULL;
}

/* Delay.Q */
static const char *output_name(struct fbd_edit *edit, const struct fbd_node *block, const char *pin)
{
	const size_t size = strlen(block->text) + strlen(pin) + 2;
	char *text = arena_alloc(&edit->net.arena, size);

	if (text)
		snprintf(text, size, "%s.%s", block->text, pin);
	return text;
}

/* The name by which an output is read; @at gets the line that gives it. NULL: refused. */
static const char *output_of(struct fbd_edit *edit, struct box_at *at, const struct fbd_spot *spot)
{
	const char *pin = spot->pin && spot->pin[0] ? spot->pin : NULL;
	bool instance;
	int index;

	if (!at->node) {
		if (at->line->kind == FBD_LINE_ASSIGN)
			return at->line->target;
		refuse(edit, NO_OUTPUT);
		return NULL;
	}
	if (at->node->kind == FBD_NODE_INFIX || is_edge(at->node))
		return result_of(edit, at);
	row_of(edit, at->node, &instance);
	if (!instance)
		return !pin || name_equal(pin, "OUT") ? result_of(edit, at) : named_output(edit, at, pin);
	pin = pin ? pin : first_output(edit, at->node);
	if (!pin) {
		refuse(edit, NO_OUTPUT);
		return NULL;
	}
	index = arg_of(edit, at->node, pin, true);
	if (index >= 0 && at->node->arg[index].negated) /* what leaves the circle */
		return named_output(edit, at, pin);
	return output_name(edit, at->node, pin);
}

/* ---- joining ---- */

static bool take(struct fbd_edit *edit, const struct box_at *source, const char *name, struct fbd_line *line,
		 struct fbd_node **slot)
{
	const bool wire = strcspn(name, ".") == strlen(name) && is_wire_name(edit, name);
	const bool loop = needs_any(edit, source->line, line);
	struct fbd_node *value = operand(edit, name), *past;

	if (wire && loop) {
		past = fbd_node_new(&edit->net, FBD_NODE_CALL, "PREVIOUS");
		if (!past || !fbd_node_push(&edit->net, past, NULL, value))
			return refuse(edit, NO_MEMORY);
		value = past;
	}
	if (*slot && is_not(*slot) && is_circle(*slot))
		slot = &(*slot)->arg[0].value;
	replace(edit, line, slot, value);
	if (!loop && index_of(edit, source->line) > index_of(edit, line) &&
	    !sort(edit, source->line, line) && wire)
		return refuse(edit, N_("The network has a loop already."));
	return finish(edit, line);
}

bool fbd_edit_join(struct fbd_edit *edit, const struct fbd_spot *from, const struct fbd_spot *to)
{
	struct box_at source = { .line = NULL }, target = { .line = NULL };
	struct fbd_node **slot;
	const char *name;

	if (!from->output || to->output)
		return refuse(edit, N_("A wire leads from an output to an input."));
	if (!find(edit, from, &source) || !find(edit, to, &target))
		return false;
	name = output_of(edit, &source, from);
	if (!name)
		return false;
	if (target.node)
		slot_of(edit, target.node, &target.line);
	slot = input_of(edit, &target, to);
	if (!slot)
		return false;
	return take(edit, &source, name, target.line, slot);
}

static bool clear_output(struct fbd_edit *edit, const struct box_at *at, const struct fbd_spot *spot)
{
	const int index = at->node && at->node->kind == FBD_NODE_CALL && spot->pin ?
			  arg_of(edit, at->node, spot->pin, true) : -1;
	const char *name;

	if (index < 0)
		return refuse(edit, N_("Nothing is connected here."));
	name = at->node->arg[index].value ? at->node->arg[index].value->text : "";
	fbd_node_drop(at->node, index);
	at->line->changed = true;
	if (is_wire_name(edit, name))
		replace_everywhere(edit, name, NULL);
	return finish(edit, at->line);
}

bool fbd_edit_clear(struct fbd_edit *edit, const struct fbd_spot *pin)
{
	struct box_at at = { .line = NULL };
	struct fbd_node **slot;

	if (!find(edit, pin, &at))
		return false;
	if (pin->output)
		return clear_output(edit, &at, pin);
	slot = input_of(edit, &at, pin);
	if (!slot)
		return false;
	if (!*slot)
		return refuse(edit, N_("Nothing is connected here."));
	detach(edit, at.line, slot);
	fill(edit, at.line);
	return finish(edit, at.line);
}

/* ---- operands ---- */

/* What an output gives gets a name: that of a wire, or a variable that stores it. */
static bool store_result(struct fbd_edit *edit, struct box_at *at, const char *text)
{
	const char *wire = result_of(edit, at);
	struct fbd_line *line;
	int readers = 0;

	if (!wire)
		return refuse(edit, NO_MEMORY);
	if (is_wire_name(edit, text))
		return name_equal(wire, text) ? finish(edit, at->line) : fbd_edit_rename(edit, wire, text);
	for (int i = 0; i < edit->net.count; i++)
		readers += names_it(edit->net.line[i]->value, wire);
	if (!readers) {
		at->line->target = text;
		at->line->changed = true;
		return finish(edit, at->line);
	}
	line = fbd_net_insert(&edit->net, index_of(edit, at->line) + 1, FBD_LINE_ASSIGN);
	if (!line)
		return refuse(edit, NO_MEMORY);
	line->target = text;
	line->value = operand(edit, wire);
	return finish(edit, line);
}

static bool set_output(struct fbd_edit *edit, struct box_at *at, const struct fbd_spot *pin,
		       const struct fbd_node *value)
{
	const char *name = pin->pin ? pin->pin : "";
	bool instance = false;
	int index;

	if (!value || value->kind != FBD_NODE_OPERAND || strchr("0123456789'\"-", value->text[0]))
		return refuse(edit, N_("This is not a variable."));
	if (!at->node) {
		if (gives_wire(edit, at->line) && is_wire_name(edit, value->text))
			return fbd_edit_rename(edit, at->line->target, value->text);
		at->line->target = value->text;
		at->line->changed = true;
		return finish(edit, at->line);
	}
	if (at->node->kind == FBD_NODE_CALL)
		row_of(edit, at->node, &instance);
	if (at->node->kind != FBD_NODE_CALL || is_edge(at->node) ||
	    (!instance && (!name[0] || name_equal(name, "OUT"))))
		return store_result(edit, at, value->text);
	if (!name[0])
		name = first_output(edit, at->node);
	if (!name)
		return refuse(edit, NO_OUTPUT);
	if (!named_output(edit, at, name))
		return false;
	index = arg_of(edit, at->node, name, true);
	at->node->arg[index].value->text = value->text;
	at->line->changed = true;
	return sorted(edit, at->line);
}

bool fbd_edit_operand(struct fbd_edit *edit, const struct fbd_spot *pin, const char *text)
{
	struct box_at at = { .line = NULL };
	struct fbd_node **slot, *value;

	if (!text[strspn(text, " ")])
		return fbd_edit_clear(edit, pin);
	if (!find(edit, pin, &at))
		return false;
	value = fbd_net_value(&edit->net, text, strlen(text));
	if (pin->output)
		return set_output(edit, &at, pin, value);
	if (!value)
		return refuse(edit, NO_VALUE);
	slot = input_of(edit, &at, pin);
	if (!slot)
		return false;
	replace(edit, at.line, slot, value);
	return sorted(edit, at.line);
}

/* Is an operand of the value just this? */
static bool has_operand(const struct fbd_node *node, const char *text)
{
	if (!node)
		return false;
	if (node->kind == FBD_NODE_OPERAND)
		return name_equal(node->text, text);
	for (int i = 0; i < node->count; i++)
		if (has_operand(node->arg[i].value, text))
			return true;
	return false;
}

/* The circle of an output belongs to `Q => Lamp`. An output that is read by its own name gets a wire. */
static bool negate_output(struct fbd_edit *edit, struct box_at *at, const struct fbd_spot *spot)
{
	bool instance = false, is_read = false;
	const char *pin = spot->pin && spot->pin[0] ? spot->pin : NULL, *own;
	struct fbd_arg *arg;
	int index;

	if (at->node && at->node->kind == FBD_NODE_CALL && !is_edge(at->node))
		row_of(edit, at->node, &instance);
	else
		pin = NULL;
	if (!pin || (!instance && name_equal(pin, "OUT")))
		return refuse(edit, N_("A result is negated at the inputs that read it."));
	own = instance ? output_name(edit, at->node, pin) : NULL;
	for (int i = index_of(edit, at->line) + 1; own && i < edit->net.count; i++)
		is_read = is_read || has_operand(edit->net.line[i]->value, own);
	index = arg_of(edit, at->node, pin, true);
	if (!is_read && (index < 0 || !at->node->arg[index].value))
		return refuse(edit, N_("Nothing is connected here."));
	if (!named_output(edit, at, pin) || !name_args(edit, at->node))
		return false;
	arg = &at->node->arg[arg_of(edit, at->node, pin, true)];
	arg->negated = !arg->negated;
	at->line->changed = true;
	for (int i = index_of(edit, at->line) + 1; is_read && arg->negated && i < edit->net.count; i++)
		replace_reads(edit, edit->net.line[i], &edit->net.line[i]->value, own, arg->value->text);
	return finish(edit, at->line);
}

bool fbd_edit_negate(struct fbd_edit *edit, const struct fbd_spot *pin)
{
	struct box_at at = { .line = NULL };
	struct fbd_node **slot, *value;

	if (!find(edit, pin, &at))
		return false;
	if (pin->output)
		return negate_output(edit, &at, pin);
	slot = input_of(edit, &at, pin);
	if (!slot)
		return false;
	if (!*slot)
		return refuse(edit, N_("Nothing is connected here."));
	at.line->changed = true;
	if (is_not(*slot) && (*slot)->arg[0].value) {
		*slot = (*slot)->arg[0].value;
		return finish(edit, at.line);
	}
	value = fbd_node_new(&edit->net, FBD_NODE_INFIX, "NOT");
	if (!value || !fbd_node_push(&edit->net, value, NULL, *slot))
		return refuse(edit, NO_MEMORY);
	*slot = value;
	return finish(edit, at.line);
}

/* ---- the number of inputs ---- */

/* How many inputs a call has: those of its row, and those that were added. */
static int inputs_of(struct fbd_edit *edit, const struct fbd_node *node, const struct word_row *row)
{
	char name[LIMIT_NAME + 1];
	int most = row->pin_count;

	for (int i = most; i < FBD_MOST_INPUTS; i++) {
		expr_pin_name(row, i, name, sizeof(name));
		if (arg_of(edit, node, name, false) >= 0)
			most = i + 1;
	}
	return most;
}

bool fbd_edit_add_input(struct fbd_edit *edit, const struct fbd_spot *box)
{
	struct box_at at = { .line = NULL };
	const struct word_row *row;
	char name[LIMIT_NAME + 1];
	bool instance;
	int count;

	if (!find(edit, box, &at))
		return false;
	row = at.node ? row_of(edit, at.node, &instance) : NULL;
	if (!row || instance || row->kind != WORD_FN || !row->most_inputs)
		return refuse(edit, N_("This box has a fixed number of inputs."));
	count = at.node->kind == FBD_NODE_INFIX ? at.node->count : inputs_of(edit, at.node, row);
	if (count >= FBD_MOST_INPUTS || count >= row->most_inputs)
		return refuse(edit, N_("This box cannot have more inputs."));
	expr_pin_name(row, count, name, sizeof(name));
	if (at.node->kind == FBD_NODE_CALL && !name_args(edit, at.node))
		return false;
	if (!fbd_node_push(&edit->net, at.node, at.node->kind == FBD_NODE_CALL ?
			   arena_copy(&edit->net.arena, name, strlen(name)) : NULL, NULL))
		return refuse(edit, NO_MEMORY);
	at.line->changed = true;
	return finish(edit, at.line);
}

/* The pins behind a dropped one move up. */
static void renumber(struct fbd_edit *edit, struct fbd_node *node, const struct word_row *row, int from)
{
	char name[LIMIT_NAME + 1], before[LIMIT_NAME + 1];

	for (int i = from + 1; i < FBD_MOST_INPUTS; i++) {
		int index;

		expr_pin_name(row, i, name, sizeof(name));
		expr_pin_name(row, i - 1, before, sizeof(before));
		index = arg_of(edit, node, name, false);
		if (index >= 0)
			node->arg[index].pin = arena_copy(&edit->net.arena, before, strlen(before));
	}
}

bool fbd_edit_drop_input(struct fbd_edit *edit, const struct fbd_spot *pin)
{
	struct box_at at = { .line = NULL };
	const struct word_row *row;
	bool instance;
	int index;

	if (!find(edit, pin, &at))
		return false;
	row = at.node ? row_of(edit, at.node, &instance) : NULL;
	if (!row || instance || row->kind != WORD_FN || !row->most_inputs || pin->output)
		return refuse(edit, N_("This box has a fixed number of inputs."));
	if ((at.node->kind == FBD_NODE_INFIX ? at.node->count : inputs_of(edit, at.node, row)) <= row->pin_count)
		return refuse(edit, N_("This box needs its inputs."));
	if (at.node->kind == FBD_NODE_CALL && !name_args(edit, at.node))
		return false;
	index = at.node->kind == FBD_NODE_INFIX ? pin->number :
		pin->pin ? arg_of(edit, at.node, pin->pin, false) : -1;
	if (index >= at.node->count || (index < 0 && at.node->kind == FBD_NODE_INFIX))
		return refuse(edit, GONE);
	if (index >= 0) {
		detach(edit, at.line, &at.node->arg[index].value);
		fbd_node_drop(at.node, index);
	}
	if (at.node->kind == FBD_NODE_CALL)
		renumber(edit, at.node, row, pin->number);
	at.line->changed = true;
	return finish(edit, at.line);
}

/* ---- new boxes ---- */

static int behind_statement(const struct fbd_edit *edit, int behind)
{
	const int at = behind < 0 ? -1 : line_of(edit, behind);

	return behind >= 0 && at < 0 ? edit->net.count : at + 1;
}

bool fbd_edit_line(struct fbd_edit *edit, int behind, const char *text)
{
	const int at = behind_statement(edit, behind), before = edit->net.count;
	struct fbd_line *line;

	if (!fbd_net_read(&edit->net, text, strlen(text)))
		return refuse(edit, NO_MEMORY);
	if (edit->net.count != before + 1 || edit->net.line[before]->kind == FBD_LINE_OTHER)
		return refuse(edit, N_("This is not a line of a network: type a box, or target := value."));
	line = edit->net.line[before];
	memmove(edit->net.line + at + 1, edit->net.line + at, (size_t)(before - at) * sizeof(line));
	edit->net.line[at] = line;
	line->changed = true;
	return sorted(edit, line);
}

/* A box with open inputs, not in a line yet. */
static struct fbd_node *new_box(struct fbd_edit *edit, const char *word, const char *instance)
{
	const char *sign = fbd_operator_word(word) ? word : fbd_word_operator(word);
	struct fbd_node *node;

	if (instance)
		return fbd_node_new(&edit->net, FBD_NODE_CALL, instance);
	if (name_equal(word, "R_EDGE") || name_equal(word, "F_EDGE")) {
		node = fbd_node_new(&edit->net, FBD_NODE_CALL, word);
		return node && fbd_node_push(&edit->net, node, NULL, NULL) ? node : NULL;
	}
	node = fbd_node_new(&edit->net, sign ? FBD_NODE_INFIX : FBD_NODE_CALL, sign ? sign : word);
	for (int i = 0; node && sign && i < (name_equal(sign, "NOT") ? 1 : 2); i++)
		if (!fbd_node_push(&edit->net, node, NULL, NULL))
			return NULL;
	return node;
}

static struct fbd_line *new_line(struct fbd_edit *edit, int at, struct fbd_node *node, bool instance)
{
	struct fbd_line *line = node ? fbd_net_insert(&edit->net, at, instance ? FBD_LINE_CALL : FBD_LINE_ASSIGN) :
				NULL;

	if (!line)
		return NULL;
	line->value = node;
	line->target = instance ? NULL : fresh_wire(edit);
	return line;
}

bool fbd_edit_add(struct fbd_edit *edit, int behind, const char *word, const char *instance)
{
	const struct fbd_line *line = new_line(edit, behind_statement(edit, behind),
					       new_box(edit, word, instance), instance != NULL);

	return line ? finish(edit, line) : refuse(edit, NO_MEMORY);
}

/* The first input of a new box gets a value. */
static bool feed(struct fbd_edit *edit, struct fbd_node *node, struct fbd_node *value)
{
	bool instance;
	const struct word_row *row;

	if (node->kind == FBD_NODE_INFIX || is_edge(node)) {
		node->arg[0].value = value;
		return true;
	}
	row = row_of(edit, node, &instance);
	for (int i = 0; row && i < row->pin_count; i++)
		if ((!instance && row->most_inputs) || pin_is_given(&row->pin[i]))
			return fbd_node_push(&edit->net, node, row->pin[i].name, value) != NULL;
	return refuse(edit, N_("This box has no input."));
}

bool fbd_edit_append(struct fbd_edit *edit, const struct fbd_spot *from, const char *word, const char *instance)
{
	struct box_at source = { .line = NULL };
	struct fbd_node *node = new_box(edit, word, instance);
	struct fbd_line *line;
	const char *name;

	if (!find(edit, from, &source))
		return false;
	name = output_of(edit, &source, from);
	line = name ? new_line(edit, index_of(edit, source.line) + 1, node, instance != NULL) : NULL;
	if (!line)
		return edit->why ? false : refuse(edit, NO_MEMORY);
	return feed(edit, node, operand(edit, name)) && finish(edit, line);
}

bool fbd_edit_insert(struct fbd_edit *edit, const struct fbd_spot *to, const char *word, const char *instance)
{
	struct box_at at = { .line = NULL };
	struct fbd_node *node = new_box(edit, word, instance), **slot;
	struct fbd_spot result = { .output = true };
	struct box_at made;
	const char *name;

	if (!find(edit, to, &at))
		return false;
	slot = to->output ? NULL : input_of(edit, &at, to);
	if (!slot || !node)
		return refuse(edit, N_("Select an input: the box is put before it."));
	if (*slot && !feed(edit, node, *slot))
		return false;
	*slot = node;
	at.line->changed = true;
	if (!instance)
		return finish(edit, at.line);
	made = (struct box_at){ .line = new_line(edit, index_of(edit, at.line), node, true), .node = node };
	if (!made.line)
		return refuse(edit, NO_MEMORY);
	*slot = NULL;
	name = output_of(edit, &made, &result);
	if (!name)
		return false;
	*slot = operand(edit, name);
	return finish(edit, made.line);
}

bool fbd_edit_store(struct fbd_edit *edit, const struct fbd_spot *from, enum fbd_line_kind kind, const char *target)
{
	struct box_at source = { .line = NULL };
	struct fbd_line *line;
	const char *name;

	if (!find(edit, from, &source))
		return false;
	name = output_of(edit, &source, from);
	if (!name)
		return false;
	line = fbd_net_insert(&edit->net, index_of(edit, source.line) + 1, kind);
	if (!line)
		return refuse(edit, NO_MEMORY);
	line->target = target ? arena_copy(&edit->net.arena, target, strlen(target)) : NULL;
	line->value = operand(edit, name);
	return finish(edit, line);
}

/* ---- removing ---- */

/* Does a box give a value of the type that its inputs have? */
static bool is_through(struct fbd_edit *edit, const struct fbd_node *node)
{
	bool instance;
	const struct word_row *row = row_of(edit, node, &instance);

	if (is_edge(node))
		return true;
	return row && !instance && word_shares(row);
}

/* The only value of a box that is not a constant, if it may stand in place of the box. */
static struct fbd_node *passed(struct fbd_edit *edit, const struct fbd_node *node)
{
	struct fbd_node *only = NULL;

	if (!is_through(edit, node))
		return NULL;
	for (int i = 0; i < node->count; i++) {
		struct fbd_node *value = node->arg[i].output ? NULL : node->arg[i].value;

		if (!value || (value->kind == FBD_NODE_OPERAND && strchr("0123456789-", value->text[0])))
			continue;
		if (only)
			return NULL;
		only = value;
	}
	return only;
}

/* The boxes at its other inputs stay. */
static void free_inputs(struct fbd_edit *edit, struct fbd_line *line, struct fbd_node *node,
			const struct fbd_node *except)
{
	for (int i = 0; i < node->count; i++)
		if (!node->arg[i].output && node->arg[i].value && node->arg[i].value != except)
			detach(edit, line, &node->arg[i].value);
}

static void remove_line(struct fbd_edit *edit, const struct fbd_line *line)
{
	fbd_net_remove(&edit->net, index_of(edit, line));
}

static void remove_node(struct fbd_edit *edit, struct fbd_node *node)
{
	struct fbd_line *line = NULL;
	struct fbd_node **slot = slot_of(edit, node, &line), *value;
	const char *wire;

	if (!slot)
		return;
	value = passed(edit, node);
	free_inputs(edit, line, node, value);
	*slot = value;
	line->changed = true;
	if (slot != &line->value) {
		return;
	} else if (line->kind == FBD_LINE_CALL) {
		remove_line(edit, line);
	} else if (gives_wire(edit, line) && !is_box(value)) {
		wire = line->target;
		remove_line(edit, line);
		replace_everywhere(edit, wire, value ? fbd_node_text(&edit->net, value) : NULL);
	} else {
		fill(edit, line);
	}
}

/* The store, jump or value at the end of a line. */
static void remove_end(struct fbd_edit *edit, struct fbd_line *line)
{
	if (index_of(edit, line) < 0)
		return;
	if (is_box(line->value) && !is_open_value(line->value)) {
		line->kind = FBD_LINE_ASSIGN;
		line->target = fresh_wire(edit);
		line->changed = true;
		return;
	}
	remove_line(edit, line);
	if (gives_wire(edit, line))
		replace_everywhere(edit, line->target,
				   line->value ? fbd_node_text(&edit->net, line->value) : NULL);
}

bool fbd_edit_remove(struct fbd_edit *edit, const struct fbd_spot *spot, int count)
{
	struct box_at *at = arena_alloc(&edit->net.arena, (size_t)(count + 1) * sizeof(*at));

	if (!at)
		return refuse(edit, NO_MEMORY);
	for (int i = 0; i < count; i++)
		if (!find(edit, &spot[i], &at[i]))
			return false;
	for (int i = 0; i < count; i++)
		if (at[i].node)
			remove_node(edit, at[i].node);
		else
			remove_end(edit, at[i].line);
	return sorted(edit, NULL);
}

/* ---- types, names, order, places ---- */

/* Arguments of another box, by their places. */
static void fit_args(struct fbd_edit *edit, struct fbd_line *line, struct fbd_node *node,
		     const struct word_row *row)
{
	const bool infix = node->kind == FBD_NODE_INFIX;
	int most = !row ? node->count : row->most_inputs ? row->most_inputs : row->pin_count, number = 0;
	char name[LIMIT_NAME + 1];

	for (int i = 0; i < node->count; i++) {
		struct fbd_arg *arg = &node->arg[i];
		const bool enable = arg->pin && (name_equal(arg->pin, "EN") || arg->output);

		if (enable ? infix : number >= most) {
			detach(edit, line, &arg->value);
			fbd_node_drop(node, i--);
			continue;
		}
		if (enable)
			continue;
		if (row && !infix)
			expr_pin_name(row, number, name, sizeof(name));
		arg->pin = row && !infix ? arena_copy(&edit->net.arena, name, strlen(name)) : NULL;
		number++;
	}
	for (; infix && node->count < (most < 2 ? most : 2);)
		if (!fbd_node_push(&edit->net, node, NULL, NULL))
			return;
}

bool fbd_edit_type(struct fbd_edit *edit, const struct fbd_spot *box, const char *word)
{
	struct box_at at = { .line = NULL };
	const char *sign = fbd_operator_word(word) ? word : fbd_word_operator(word);
	bool instance = false;

	if (!find(edit, box, &at))
		return false;
	if (!at.node)
		return refuse(edit, N_("This box has no type."));
	if (at.node->kind == FBD_NODE_CALL)
		row_of(edit, at.node, &instance);
	word = arena_copy(&edit->net.arena, word, strlen(word));
	at.line->changed = true;
	if (instance) {
		const char *old = at.node->text;

		at.node->text = word;
		row_of(edit, at.node, &instance);
		if (!instance)
			return refuse(edit, N_("This box is an instance: type the name of another one."));
		return fbd_edit_rename(edit, old, word);
	}
	if (at.node->kind == FBD_NODE_CALL && !name_args(edit, at.node))
		return false;
	at.node->kind = sign ? FBD_NODE_INFIX : FBD_NODE_CALL;
	at.node->text = sign ? sign : word;
	fit_args(edit, at.line, at.node, row_of(edit, at.node, &instance));
	return finish(edit, at.line);
}

static const char *renamed(struct fbd_edit *edit, const char *path, const char *wire, const char *name)
{
	char *text = fbd_name_replaced(path, wire, name);
	const char *out = text ? arena_copy(&edit->net.arena, text, strlen(text)) : NULL;

	free(text);
	return out ? out : path;
}

static void rename_in(struct fbd_edit *edit, struct fbd_line *line, struct fbd_node *node, const char *wire,
		      const char *name)
{
	if (!node)
		return;
	if (node->kind == FBD_NODE_OPERAND && mentions(node->text, wire)) {
		node->text = renamed(edit, node->text, wire, name);
		line->changed = true;
	}
	for (int i = 0; i < node->count; i++)
		rename_in(edit, line, node->arg[i].value, wire, name);
}

static void rename_lines(struct fbd_edit *edit, int from, const char *wire, const char *name)
{
	for (int i = from; i < edit->net.count; i++) {
		struct fbd_line *line = edit->net.line[i];

		rename_in(edit, line, line->value, wire, name);
		if (line->target && line->kind != FBD_LINE_JUMP && mentions(line->target, wire)) {
			line->target = renamed(edit, line->target, wire, name);
			line->changed = true;
		}
	}
}

bool fbd_edit_rename(struct fbd_edit *edit, const char *wire, const char *name)
{
	const char *new = arena_copy(&edit->net.arena, name, strlen(name));

	if (!new)
		return refuse(edit, NO_MEMORY);
	if (is_wire_name(edit, wire) && is_wire_name(edit, new) && !name_equal(wire, new) && is_named(edit, new))
		return refuse(edit, N_("Another wire of this network has this name."));
	rename_lines(edit, 0, wire, new);
	return finish(edit, edit->made);
}

bool fbd_edit_move(struct fbd_edit *edit, int statement, bool down)
{
	const int at = line_of(edit, statement), other = line_of(edit, statement + (down ? 1 : -1));
	struct fbd_line *line;

	if (at < 0 || statement + (down ? 1 : -1) < 0 || other < 0)
		return refuse(edit, down ? N_("This is the last line of the network.") :
			      N_("This is the first line of the network."));
	if (needs(edit, edit->net.line[down ? other : at], edit->net.line[down ? at : other]))
		return refuse(edit, N_("The order of these two follows from their wire."));
	line = edit->net.line[at];
	edit->net.line[at] = edit->net.line[other];
	edit->net.line[other] = line;
	return finish(edit, line);
}

bool fbd_edit_place(struct fbd_edit *edit, const struct fbd_spot *box, int column, int row)
{
	struct box_at at = { .line = NULL };

	if (!find(edit, box, &at))
		return false;
	if (at.node && at.node != at.line->value)
		at.line = extract(edit, at.line, slot_of(edit, at.node, &at.line));
	else if (!at.node && is_box(at.line->value) && !extract(edit, at.line, &at.line->value))
		return refuse(edit, NO_MEMORY);
	if (!at.line)
		return refuse(edit, NO_MEMORY);
	at.line->column = column;
	at.line->row = row;
	at.line->changed = true;
	return finish(edit, at.line);
}

/* ---- copies ---- */

char *fbd_edit_copy(struct fbd_edit *edit, const struct fbd_spot *spot, int count)
{
	struct fbd_net part = edit->net;
	struct fbd_line **line = arena_alloc(&edit->net.arena, (size_t)(edit->net.count + 1) * sizeof(*line));

	if (!line)
		return NULL;
	part.line = line;
	part.count = 0;
	for (int i = 0; i < edit->net.count; i++)
		for (int k = 0; k < count; k++)
			if (line_of(edit, spot[k].statement) == i) {
				line[part.count++] = edit->net.line[i];
				break;
			}
	return fbd_net_write(&part);
}

bool fbd_edit_paste(struct fbd_edit *edit, int behind, const char *text)
{
	const int at = behind_statement(edit, behind), before = edit->net.count;
	struct fbd_line **copy;
	size_t count;

	if (!fbd_net_read(&edit->net, text, strlen(text)))
		return refuse(edit, NO_MEMORY);
	count = (size_t)(edit->net.count - before);
	if (count == 0)
		return refuse(edit, N_("The clipboard has no boxes."));
	for (int i = before; i < edit->net.count; i++) {
		struct wires wires;

		if (edit->net.line[i]->kind == FBD_LINE_OTHER)
			return refuse(edit, N_("The clipboard has no boxes."));
		wires_of(edit, edit->net.line[i], &wires);
		for (int k = 0; k < wires.count; k++) {
			edit->net.count = before;
			if (is_named(edit, wires.name[k])) {
				edit->net.count = before + (int)count;
				rename_lines(edit, before, wires.name[k], fresh_wire(edit));
			}
			edit->net.count = before + (int)count;
		}
	}
	copy = arena_alloc(&edit->net.arena, count * sizeof(*copy));
	if (!copy)
		return refuse(edit, NO_MEMORY);
	memcpy(copy, edit->net.line + before, count * sizeof(*copy));
	memmove(edit->net.line + at + count, edit->net.line + at, (size_t)(before - at) * sizeof(*copy));
	memcpy(edit->net.line + at, copy, count * sizeof(*copy));
	return sorted(edit, copy[count - 1]);
}

/* ---- headings ---- */

char *fbd_heading_text(const struct fbd_heading *heading)
{
	struct sink_memory memory;

	sink_memory_init(&memory);
	const struct sink sink = sink_to_memory(&memory);

	if (heading->comment && heading->comment[0])
		sink_printf(&sink, "%s\n", heading->comment);
	sink_text(&sink, heading->off ? "NETWORK OFF" : "NETWORK");
	if (heading->label && heading->label[0])
		sink_printf(&sink, " %s", heading->label);
	if (heading->title && heading->title[0]) {
		sink_text(&sink, " \"");
		for (const char *p = heading->title; *p; p++) {
			sink_text(&sink, *p == '"' || *p == '$' ? "$" : "");
			sink_write(&sink, p, 1);
		}
		sink_text(&sink, "\"");
	}
	sink_text(&sink, "\n");
	if (memory.failed) {
		sink_memory_free(&memory);
		return NULL;
	}
	return memory.text;
}
