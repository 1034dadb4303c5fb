/* SPDX-License-Identifier: MIT
 *
 * fbd_ladder - networks as rungs: each line becomes one, and values that stand at no cell get rungs before.
 *
 * A rung computes what its line computes, in the same order. What no contact, box or [ … ] computes in the same
 * way stands in an EXECUTE box, as Structured Text: calls with other pins, bit strings as numbers.
 */
#include "engine/convert/networks.h"

#include "engine/base/ascii.h"
#include "engine/base/literal.h"
#include "engine/base/name.h"
#include "engine/check/infer.h"
#include "engine/check/mixed.h"
#include "engine/model/expr_args.h"
#include "engine/model/fbd.h"
#include "engine/text/text.h"

#include <stdio.h>
#include <string.h>

enum { WIDE = 24 }; /* columns and rows of what one rung connects, as far as a part can be kept aside */

enum path_kind { PATH_WIRE, PATH_CELL, PATH_SERIES, PATH_PARALLEL };

/* Between two nets of a rung. */
struct path {
	enum path_kind kind;
	uint32_t text;         /* of a cell: string id                         */
	const struct path *part[2];
	int width, height;
	bool edge;             /* an edge is in it                             */
};

/* A pin of a box that a branch feeds. */
struct branch {
	uint32_t pin;
	const struct path *path;
};

struct ladders {
	struct networks names;
	struct acts *acts;
	const struct sink *sink;
	const struct fbd_network *network;
	bool begun;            /* it has a rung                                */
	int skip;              /* so many lines stand in the rung before       */
	uint32_t comment;      /* for the next rung: string id                 */
	uint32_t (*cell)[LIMIT_COLS]; /* string ids                            */
	bool (*link)[LIMIT_COLS]; /* of the bar behind the cell                 */
	int rows, cols;        /* of the rung in work                          */
	bool edges;            /* those of the value may be kept aside before it */
	struct infer infer;
	struct diag_list *ignored; /* texts that were read before              */
	struct path no_path;   /* given when memory is out                     */
};

/* The box of a line, while its arguments are looked at. */
struct box {
	struct sink_memory text;
	struct branch branch[LIMIT_ARGS];
	int branches;
	const struct path *power;
	const struct path *after; /* between the box and its coil; NULL: nothing */
	uint32_t behind[WIDE]; /* the coils behind it: string ids              */
	int coils;
	struct inverted { uint32_t pin, place; } inverted[WIDE]; /* NOT pin => place: string ids */
	int inversions;
};

static const char *text_of(const struct ladders *l, uint32_t id)
{
	return project_text(l->acts->project, id);
}

static struct expr_node *node_of(const struct ladders *l, int at)
{
	return &l->acts->expr->node[at];
}

/* The text of the memory as a string id; frees it. */
static uint32_t take_text(struct ladders *l, struct sink_memory *memory)
{
	const uint32_t id = acts_intern(l->acts, sink_memory_text(memory), memory->len);

	l->acts->failed |= memory->failed;
	sink_memory_free(memory);
	return id;
}

/* ---- paths ---- */

static const struct path *path_new(struct ladders *l, enum path_kind kind, uint32_t text)
{
	struct path *path = arena_alloc(l->acts->arena, sizeof(*path));

	if (!path) {
		l->acts->failed = true;
		return &l->no_path;
	}
	*path = (struct path){ .kind = kind, .text = text, .width = kind != PATH_WIRE, .height = 1 };
	return path;
}

static const struct path *cell(struct ladders *l, const char *word, const char *operand)
{
	struct sink_memory memory;

	sink_memory_init(&memory);
	const struct sink sink = sink_to_memory(&memory);

	sink_printf(&sink, "%s %s", word, operand);
	return path_new(l, PATH_CELL, take_text(l, &memory));
}

/* ---- rungs ---- */

/* The comments of the network and of its line. */
static uint32_t comments(struct ladders *l)
{
	struct sink_memory memory;

	if (l->begun || !l->network->comment)
		return l->comment;
	if (!l->comment)
		return l->network->comment;
	sink_memory_init(&memory);
	const struct sink sink = sink_to_memory(&memory);

	sink_printf(&sink, "%s\n%s", text_of(l, l->network->comment), text_of(l, l->comment));
	return take_text(l, &memory);
}

static void heading(struct ladders *l)
{
	const struct fbd_network *network = l->network;
	const bool empty = network->off && network->label && networks_lead(&l->names, network->label);
	const struct text_heading text = { l->begun || empty ? 0 : network->label, l->begun ? 0 : network->title, comments(l),
					   network->off };

	text_write_heading(l->acts->project, "RUNG", &text, l->sink);
	sink_text(l->sink, "\n");
	l->begun = true;
	l->comment = 0;
}

static void set(struct ladders *l, int row, int col, uint32_t text)
{
	if (row >= LIMIT_ROWS || col >= LIMIT_COLS) {
		l->acts->refused = true;
		return;
	}
	l->cell[row][col] = text;
	l->rows = row >= l->rows ? row + 1 : l->rows;
	l->cols = col >= l->cols ? col + 1 : l->cols;
}

/* Joins bar @col of the rows from @from on to @to with the row above each. Bar 0 is the rail. */
static void join(struct ladders *l, int from, int to, int col)
{
	for (int row = from; col > 0 && row <= to; row++)
		if (row < LIMIT_ROWS && col <= LIMIT_COLS) {
			l->link[row][col - 1] = true;
			l->rows = row >= l->rows ? row + 1 : l->rows;
		}
}

static void fill(struct ladders *l, int row, int from, int to)
{
	const uint32_t wire = acts_intern(l->acts, "---", 3);

	for (; from < to; from++)
		set(l, row, from, wire);
}

static void place(struct ladders *l, const struct path *path, int row, int col)
{
	const struct path *a = path->part[0], *b = path->part[1];

	switch (path->kind) {
	case PATH_WIRE:
		break;
	case PATH_CELL:
		set(l, row, col, path->text);
		break;
	case PATH_SERIES:
		place(l, a, row, col);
		place(l, b, row, col + a->width);
		break;
	case PATH_PARALLEL:
		place(l, a, row, col);
		fill(l, row, col + a->width, col + path->width);
		place(l, b, row + a->height, col);
		fill(l, row + a->height, col + b->width, col + path->width);
		join(l, row + 1, row + a->height, col);
		join(l, row + 1, row + a->height, col + path->width);
		break;
	}
}

static void put_rows(struct ladders *l)
{
	for (int row = 0; row < l->rows; row++) {
		int last = l->cols;

		while (last > 1 && !l->cell[row][last - 1] && !l->link[row][last - 1])
			last--;
		sink_text(l->sink, "  |");
		for (int col = 0; col < last; col++) {
			sink_printf(l->sink, " %s%s |", text_of(l, l->cell[row][col]), l->link[row][col] ? " ^" : "");
			l->cell[row][col] = 0;
			l->link[row][col] = false;
		}
		sink_text(l->sink, "\n");
	}
	l->rows = l->cols = 0;
}

/* The rung of a condition and what it feeds: one cell, or two in series. */
static void put_rung(struct ladders *l, const struct path *path, uint32_t first, uint32_t second)
{
	heading(l);
	place(l, path, 0, 0);
	set(l, 0, path->width, first);
	if (second)
		set(l, 0, path->width + 1, second);
	put_rows(l);
}

/* The rung of a condition with several coils, from column @col on. */
static void put_coils(struct ladders *l, const uint32_t *coil, int count, int col)
{
	for (int i = 0; i < count; i++)
		set(l, i, col, coil[i]);
	join(l, 1, count - 1, col);
}

/* ---- values that are kept aside ---- */

/* Net3, Net3_2: a BOOL of the network. */
static uint32_t temp_new(struct ladders *l)
{
	const int temp = acts_temp(l->acts, IEC_BOOL, l->names.network);
	char name[32];

	if (temp < 0)
		return 0;
	snprintf(name, sizeof(name), "Net%d", l->names.network + 1);
	return l->acts->temp[temp].name = acts_name(l->acts, name);
}

static const char *keep(struct ladders *l, const struct path *path)
{
	const uint32_t temp = temp_new(l);

	put_rung(l, path, cell(l, "COIL", text_of(l, temp))->text, 0);
	return text_of(l, temp);
}

/* TRUE OR @path; an edge in it goes on remembering. */
static const struct path *beside_wire(struct ladders *l, const struct path *path)
{
	if (path->edge)
		keep(l, path);
	return path_new(l, PATH_WIRE, 0);
}

static const struct path *both(struct ladders *l, enum path_kind kind, const struct path *a, const struct path *b)
{
	const bool series = kind == PATH_SERIES;
	struct path *path;

	if (series && a->kind == PATH_WIRE)
		return b;
	if (series && b->kind == PATH_WIRE)
		return a;
	if (a->kind == PATH_WIRE || b->kind == PATH_WIRE)
		return beside_wire(l, a->kind == PATH_WIRE ? b : a);
	if (a->kind != PATH_CELL && (a->width + b->width > WIDE || a->height + b->height > WIDE))
		a = cell(l, "NO", keep(l, a));
	if (a->width + b->width > WIDE || a->height + b->height > WIDE)
		b = cell(l, "NO", keep(l, b));
	path = arena_alloc(l->acts->arena, sizeof(*path));
	if (!path) {
		l->acts->failed = true;
		return &l->no_path;
	}
	*path = (struct path){ .kind = kind, .part = { a, b }, .edge = a->edge || b->edge };
	path->width = series ? a->width + b->width : a->width > b->width ? a->width : b->width;
	path->height = !series ? a->height + b->height : a->height > b->height ? a->height : b->height;
	return path;
}

/* ---- what a node is ---- */

/* Bytes of the operand that the node is, with its bit; 0: it is none. */
static size_t operand_of(const struct ladders *l, const struct expr_node *node, const char **text)
{
	const struct expr_node *place_node = node->op == EXPR_BIT ? node_of(l, node->left) : node;

	*text = place_node->text;
	if (place_node->op != EXPR_NAME)
		return 0;
	return node->op == EXPR_BIT ? (size_t)(node->tail.text + node->tail.len - place_node->text) : place_node->len;
}

static const struct meaning *meaning_of(struct ladders *l, const struct expr_node *node)
{
	const char *text;
	const size_t len = operand_of(l, node, &text);

	return len ? acts_meaning(l->acts, acts_intern(l->acts, text, len)) : NULL;
}

static bool is_value_of_enum(struct ladders *l, const struct expr_node *node)
{
	size_t head;

	return scope_value(l->acts->scope, node->text, node->len, &head) >= 0;
}

/* Can the operand always be read? */
static bool is_sure_name(struct ladders *l, const struct expr_node *node)
{
	const struct meaning *m = meaning_of(l, node);

	return m ? !m->opens && !m->through : node->op == EXPR_NAME && is_value_of_enum(l, node);
}

static enum fbd_word word_of(struct ladders *l, int at, int *argument)
{
	struct expr_node *arg = NULL;
	const enum fbd_word is = fbd_word(l->acts->expr, node_of(l, at), &arg);

	*argument = arg ? (int)(arg - l->acts->expr->node) : -1;
	return is;
}

/* The function of the catalogue that is called; WORD_COUNT: none. */
static enum word function_of(const struct ladders *l, const struct expr_node *node)
{
	const enum word word = node->op == EXPR_CALL ? expr_function(&l->acts->project->words, node) : WORD_COUNT;

	/* A conversion has a row in the project's table, but no owner. */
	return word != WORD_COUNT && (!word_is_own(word) || words_row(&l->acts->project->words, word)->owner < 0) ?
	       word : WORD_COUNT;
}

/* Functions that can always be computed. */
static bool is_sure_function(enum word word)
{
	return (word >= FN_GT && word <= FN_NE) || word == FN_AND || word == FN_OR || word == FN_XOR || word == FN_NOT ||
	       word == FN_SEL || word == FN_MIN || word == FN_MAX || word == FN_LIMIT;
}

/* Nest as deep as an expression: LIMIT_EXPR_DEPTH. */
static bool is_sure(struct ladders *l, int at)
{
	const struct expr_node *node = node_of(l, at);
	int arg;

	switch (node->op) {
	case EXPR_NAME: case EXPR_BIT:
		return is_sure_name(l, node);
	case EXPR_LITERAL:
		return true;
	case EXPR_NEG:
		return node_of(l, node->left)->op == EXPR_LITERAL;
	case EXPR_NOT:
		return is_sure(l, node->left);
	case EXPR_FN:
		return node->fn >= FN_GT && node->fn <= FN_NE && is_sure(l, node->left) && is_sure(l, node->right);
	case EXPR_AND: case EXPR_XOR: case EXPR_OR:
		return is_sure(l, node->left) && is_sure(l, node->right);
	case EXPR_CALL:
		switch (word_of(l, at, &arg)) {
		case FBD_PREVIOUS:
			return true;
		case FBD_RISING: case FBD_FALLING:
			return is_sure(l, arg);
		case FBD_NO_WORD:
			break;
		}
		if (!is_sure_function(function_of(l, node)))
			return false;
		for (int i = node->left; i >= 0; i = node_of(l, i)->right)
			if (node_of(l, i)->output || ascii_is("EN", node_of(l, i)->text, node_of(l, i)->len) ||
			    !is_sure(l, node_of(l, i)->left))
				return false;
		return true;
	case EXPR_INDEX: case EXPR_ARG:
		break;
	}
	return false;
}

/* Is an edge in it, or with @lazy a side that is not always computed? */
static bool has(struct ladders *l, int at, bool lazy)
{
	const struct expr_node *node = node_of(l, at);
	int arg;

	switch (node->op) {
	case EXPR_NAME: case EXPR_LITERAL:
		return false;
	case EXPR_NEG: case EXPR_NOT: case EXPR_BIT:
		return has(l, node->left, lazy);
	case EXPR_INDEX:
		return has(l, node->left, lazy) || (node->right >= 0 && has(l, node->right, lazy));
	case EXPR_FN: case EXPR_AND: case EXPR_XOR: case EXPR_OR:
		return (lazy && node->lazy) || has(l, node->left, lazy) || has(l, node->right, lazy);
	case EXPR_CALL:
		arg = -1;
		if (word_of(l, at, &arg) == FBD_RISING || word_of(l, at, &arg) == FBD_FALLING)
			return !lazy || has(l, arg, lazy);
		for (int i = node->left; i >= 0; i = node_of(l, i)->right)
			if (has(l, node_of(l, i)->left, lazy))
				return true;
		return false;
	case EXPR_ARG:
		break;
	}
	return false;
}

/* ---- what a cell [ … ] computes as a statement does ---- */

static bool is_constant(const struct ladders *l, int at)
{
	const struct expr_node *node = node_of(l, at);

	switch (node->op) {
	case EXPR_LITERAL:
		return true;
	case EXPR_NEG: case EXPR_NOT:
		return is_constant(l, node->left);
	case EXPR_FN: case EXPR_AND: case EXPR_XOR: case EXPR_OR:
		return is_constant(l, node->left) && is_constant(l, node->right);
	case EXPR_NAME: case EXPR_INDEX: case EXPR_BIT: case EXPR_CALL: case EXPR_ARG:
		break;
	}
	return false;
}

static bool is_bool(struct ladders *l, int at)
{
	return infer_type(&l->infer, at) == IEC_BOOL;
}

static bool fits_operator(struct ladders *l, const struct expr_node *node)
{
	const bool constant = is_constant(l, node->left) || is_constant(l, node->right);
	const bool tests = node->op == EXPR_FN && node->fn >= FN_GT && node->fn <= FN_NE;

	if (is_constant(l, node->left) && is_constant(l, node->right))
		return false;
	if (node->op != EXPR_FN)
		return !node->lazy && (is_bool(l, node->left) || is_constant(l, node->left)) &&
		       (is_bool(l, node->right) || is_constant(l, node->right));
	if (infer_is_roomy(&l->infer, node))
		return false;
	if (is_bool(l, node->left) || is_bool(l, node->right))
		return tests && !constant && is_bool(l, node->left) && is_bool(l, node->right);
	return true;
}

static bool is_drawn(struct ladders *l, int at);

/* Does each argument have a type that its pin takes? A statement converts more than a cell does. */
static bool fits_call(struct ladders *l, int at)
{
	const struct expr_node *node = node_of(l, at);
	const enum word word = function_of(l, node);
	const struct word_row *row;
	struct expr_args *args;
	int arg;

	switch (word_of(l, at, &arg)) {
	case FBD_PREVIOUS:
		return true;
	case FBD_RISING: case FBD_FALLING:
		return l->edges && is_drawn(l, arg);
	case FBD_NO_WORD:
		break;
	}
	if (word == WORD_COUNT)
		return false;
	row = words_row(&l->acts->project->words, word);
	args = arena_alloc(l->acts->arena, sizeof(*args));
	if (!args || expr_match(l->acts->expr, node, row, args) != DIAG_COUNT)
		return false;
	for (int i = 0; i < args->count; i++) {
		const struct word_pin *pin = word_input(row, (uint32_t)args->arg[i].pin);
		const enum iec_type type = infer_type(&l->infer, args->arg[i].at);

		if (type == IEC_BOOL ? pin->type != IEC_BOOL && !(pin->type == IEC_NONE && pin->classes & CLASS_BOOL) :
				       pin->type == IEC_BOOL && !is_constant(l, args->arg[i].at))
			return false;
		if (pin->type != IEC_NONE && type != IEC_NONE && type != pin->type && !iec_can_widen(type, pin->type))
			return false;
	}
	return args->more == 0;
}

static bool fits_node(struct ladders *l, int at)
{
	const struct expr_node *node = node_of(l, at);
	const struct meaning *m;

	switch (node->op) {
	case EXPR_NAME:
		m = meaning_of(l, node);
		return m ? !mixed_is_bits(m->type) : is_value_of_enum(l, node);
	case EXPR_NOT:
		return is_bool(l, node->left);
	case EXPR_FN: case EXPR_AND: case EXPR_XOR: case EXPR_OR:
		return fits_operator(l, node);
	case EXPR_CALL:
		return fits_call(l, at);
	case EXPR_INDEX: case EXPR_BIT:
		return infer_type(&l->infer, at) != IEC_NONE && !mixed_is_bits(infer_type(&l->infer, at));
	case EXPR_LITERAL: case EXPR_NEG: case EXPR_ARG:
		break;
	}
	return true;
}

/* The whole expression. */
static bool fits_cell(struct ladders *l)
{
	for (int i = 0; i < l->acts->expr->count; i++)
		if (!fits_node(l, i))
			return false;
	return true;
}

/* A part of one, which print() can write. @fits: a cell computes it as a statement does. */
static bool prints(struct ladders *l, int at, bool fits)
{
	const struct expr_node *node = node_of(l, at);
	const char *text;

	if (fits && !fits_node(l, at))
		return false;
	switch (node->op) {
	case EXPR_NAME: case EXPR_LITERAL:
		return true;
	case EXPR_BIT:
		return operand_of(l, node, &text) > 0;
	case EXPR_NEG: case EXPR_NOT:
		return prints(l, node->left, fits);
	case EXPR_FN: case EXPR_AND: case EXPR_XOR: case EXPR_OR:
		return prints(l, node->left, fits) && prints(l, node->right, fits);
	case EXPR_CALL:
		for (int i = node->left; i >= 0; i = node_of(l, i)->right)
			if (node_of(l, i)->output || !prints(l, node_of(l, i)->left, fits))
				return false;
		return true;
	case EXPR_INDEX: case EXPR_ARG:
		break;
	}
	return false;
}

/* ---- texts ---- */

/* A text of the line with the variables of its wires. */
static void put_text(struct ladders *l, const char *text, size_t len, const struct sink *sink)
{
	struct sink_memory none;

	sink_memory_init(&none);
	const struct sink before = sink_to_memory(&none);

	networks_text(&l->names, text, len, sink, &before);
	sink_memory_free(&none);
}

static const char *text_with_wires(struct ladders *l, const char *text, size_t len)
{
	struct sink_memory memory;

	sink_memory_init(&memory);
	const struct sink sink = sink_to_memory(&memory);

	put_text(l, text, len, &sink);
	return text_of(l, take_text(l, &memory));
}

static const char *name_text(struct ladders *l, const struct expr_node *node)
{
	const char *text;
	const size_t len = operand_of(l, node, &text);

	return text_with_wires(l, text, len);
}

static const char *sign_of(const struct expr_node *node)
{
	static const struct { enum word fn; const char *sign; } signs[] = {
		{ FN_ADD, " + " }, { FN_SUB, " - " }, { FN_MUL, " * " }, { FN_DIV, " / " }, { FN_MOD, " MOD " },
		{ FN_EXPT, " ** " }, { FN_GT, " > " }, { FN_GE, " >= " }, { FN_EQ, " = " }, { FN_LE, " <= " },
		{ FN_LT, " < " }, { FN_NE, " <> " },
	};

	if (node->op != EXPR_FN)
		return node->op == EXPR_AND ? " AND " : node->op == EXPR_OR ? " OR " : " XOR ";
	for (size_t i = 0; i < sizeof(signs) / sizeof(*signs); i++)
		if (signs[i].fn == node->fn)
			return signs[i].sign;
	return " ";
}

static void print(struct ladders *l, int at, const struct sink *sink);
static const struct path *edge_path(struct ladders *l, int arg, bool rising, bool inverse);

static void print_part(struct ladders *l, int at, const struct sink *sink)
{
	const struct expr_node *node = node_of(l, at);
	const bool compound = node->op != EXPR_NAME && node->op != EXPR_BIT && node->op != EXPR_LITERAL &&
			      node->op != EXPR_CALL;

	sink_text(sink, compound ? "(" : "");
	print(l, at, sink);
	sink_text(sink, compound ? ")" : "");
}

/* The arguments hang together from the last one on. */
static void print_args(struct ladders *l, int at, const struct sink *sink)
{
	const struct expr_node *node = at >= 0 ? node_of(l, at) : NULL;

	if (!node)
		return;
	print_args(l, node->right, sink);
	sink_text(sink, node->right >= 0 ? ", " : "");
	if (node->len) {
		sink_write(sink, node->text, node->len);
		sink_text(sink, " := ");
	}
	print(l, node->left, sink);
}

static void print(struct ladders *l, int at, const struct sink *sink)
{
	const struct expr_node *node = node_of(l, at);
	enum fbd_word is;
	const char *text;
	size_t len;
	int arg;

	switch (node->op) {
	case EXPR_NAME: case EXPR_BIT:
		len = operand_of(l, node, &text);
		put_text(l, text, len, sink);
		break;
	case EXPR_LITERAL:
		put_text(l, node->text, node->len, sink);
		break;
	case EXPR_NEG: case EXPR_NOT:
		sink_text(sink, node->op == EXPR_NEG ? "-" : "NOT ");
		print_part(l, node->left, sink);
		break;
	case EXPR_FN: case EXPR_AND: case EXPR_XOR: case EXPR_OR:
		print_part(l, node->left, sink);
		sink_text(sink, sign_of(node));
		print_part(l, node->right, sink);
		break;
	case EXPR_CALL:
		is = word_of(l, at, &arg);
		if (is == FBD_PREVIOUS) {
			const struct expr_node *wire = node_of(l, arg);

			sink_text(sink, text_of(l, networks_wire(&l->names, wire->text, wire->len, true)));
			break;
		}
		if (is != FBD_NO_WORD) {
			sink_text(sink, keep(l, edge_path(l, arg, is == FBD_RISING, false)));
			break;
		}
		sink_write(sink, node->text, node->len);
		sink_text(sink, "(");
		print_args(l, node->left, sink);
		sink_text(sink, ")");
		break;
	case EXPR_INDEX: case EXPR_ARG:
		break;
	}
}

/* [ text ], of a part or with NOT of it. */
static const struct path *test_cell(struct ladders *l, int at, bool inverse)
{
	struct sink_memory memory;

	sink_memory_init(&memory);
	const struct sink sink = sink_to_memory(&memory);

	sink_text(&sink, inverse ? "[ NOT " : "[ ");
	if (inverse)
		print_part(l, at, &sink);
	else
		print(l, at, &sink);
	sink_text(&sink, " ]");
	return path_new(l, PATH_CELL, take_text(l, &memory));
}

/* ---- conditions ---- */

/* TRUE, FALSE, 1, 0, BOOL#1. */
static bool is_true(const struct expr_node *node)
{
	const char *mark = memchr(node->text, '#', node->len);
	const char *text = mark ? mark + 1 : node->text;
	const size_t len = node->len - (size_t)(text - node->text);

	return ascii_is("TRUE", text, len) || (len == 1 && *text == '1');
}

/* A function that is an operator of BOOLs, with arguments by place. */
static enum expr_op logic_of(struct ladders *l, const struct expr_node *node)
{
	const enum word word = function_of(l, node);

	return word == FN_AND ? EXPR_AND : word == FN_OR ? EXPR_OR : word == FN_XOR ? EXPR_XOR :
	       word == FN_NOT ? EXPR_NOT : EXPR_CALL;
}

/* Can contacts say the value of the node, a BOOL? */
static bool draws(struct ladders *l, int at)
{
	const struct expr_node *node = node_of(l, at);
	int arg;

	switch (node->op) {
	case EXPR_NAME: case EXPR_BIT: {
		const struct meaning *m = meaning_of(l, node);

		return m && m->type == IEC_BOOL && !meaning_is_whole(m);
	}
	case EXPR_LITERAL:
		return true;
	case EXPR_NOT:
		return draws(l, node->left);
	case EXPR_AND: case EXPR_OR:
		return draws(l, node->left) && draws(l, node->right);
	case EXPR_XOR:
		return draws(l, node->left) && draws(l, node->right);
	case EXPR_CALL:
		switch (word_of(l, at, &arg)) {
		case FBD_PREVIOUS:
			return true;
		case FBD_RISING: case FBD_FALLING:
			return draws(l, arg);
		case FBD_NO_WORD:
			break;
		}
		if (logic_of(l, node) == EXPR_CALL)
			return !has(l, at, false) && prints(l, at, false);
		for (int i = node->left; i >= 0; i = node_of(l, i)->right)
			if (!draws(l, node_of(l, i)->left))
				return false;
		return node->left >= 0;
	case EXPR_FN:
		return !has(l, at, false) && prints(l, at, false);
	case EXPR_NEG: case EXPR_INDEX: case EXPR_ARG:
		break;
	}
	return false;
}

/* The expression at @at: contacts say it, in the same way as the line. */
static bool is_drawn(struct ladders *l, int at)
{
	return is_sure(l, at) && draws(l, at) && !(has(l, at, true) && has(l, at, false));
}

static const struct path *path_of(struct ladders *l, int at, bool inverse);
static const char *execute_value(struct ladders *l, int at);

static const struct path *edge_path(struct ladders *l, int arg, bool rising, bool inverse)
{
	const struct expr_node *node = node_of(l, arg);
	const char *operand = node->op == EXPR_NAME || node->op == EXPR_BIT ? name_text(l, node) :
						      keep(l, path_of(l, arg, false));
	struct path *path = (struct path *)cell(l, rising ? "P" : "N", operand);

	path->edge = true;
	return inverse ? cell(l, "NC", keep(l, path)) : path;
}

/* One of both, and not the other. */
static const struct path *xor_path(struct ladders *l, const struct path *a, const struct path *b, bool inverse)
{
	const char *one = keep(l, a), *other = keep(l, b);
	const struct path *first = both(l, PATH_SERIES, cell(l, "NO", one), cell(l, inverse ? "NO" : "NC", other));

	return both(l, PATH_PARALLEL, first,
		    both(l, PATH_SERIES, cell(l, "NC", one), cell(l, inverse ? "NC" : "NO", other)));
}

static bool is_contact(struct ladders *l, int at)
{
	const struct expr_node *node = node_of(l, at);
	int arg;

	return node->op == EXPR_NAME || node->op == EXPR_BIT ||
	       (node->op == EXPR_CALL && word_of(l, at, &arg) == FBD_PREVIOUS);
}

/* XOR of two contacts needs no values aside. */
static const struct path *xor_of(struct ladders *l, int left, int right, bool inverse)
{
	if (is_contact(l, left) && is_contact(l, right))
		return both(l, PATH_PARALLEL,
			    both(l, PATH_SERIES, path_of(l, left, false), path_of(l, right, !inverse)),
			    both(l, PATH_SERIES, path_of(l, left, true), path_of(l, right, inverse)));
	return xor_path(l, path_of(l, left, false), path_of(l, right, false), inverse);
}

/* AND(a, b, …) and the like: from the last argument back. */
static const struct path *call_path(struct ladders *l, const struct expr_node *node, enum expr_op op, bool inverse)
{
	const enum path_kind kind = (op == EXPR_AND) != inverse ? PATH_SERIES : PATH_PARALLEL;
	const struct path *path = NULL;
	int arg[LIMIT_FN_ARGS], count = 0;

	for (int i = node->left; i >= 0 && count < LIMIT_FN_ARGS; i = node_of(l, i)->right)
		arg[count++] = node_of(l, i)->left;
	if (op == EXPR_NOT)
		return path_of(l, arg[0], !inverse);
	for (int i = count - 1; i >= 0; i--) {
		const struct path *one = path_of(l, arg[i], op != EXPR_XOR && inverse);

		if (op == EXPR_XOR)
			path = path ? xor_path(l, path, one, inverse && i == 0) : one;
		else
			path = path ? both(l, kind, path, one) : one;
	}
	return path ? path : path_new(l, PATH_WIRE, 0);
}

static const struct path *path_of(struct ladders *l, int at, bool inverse)
{
	const struct expr_node *node = node_of(l, at);
	const struct path *first;
	enum fbd_word is;
	int arg;

	switch (node->op) {
	case EXPR_NAME: case EXPR_BIT:
		return cell(l, inverse ? "NC" : "NO", name_text(l, node));
	case EXPR_LITERAL:
		return is_true(node) != inverse ? path_new(l, PATH_WIRE, 0) : cell(l, "NC", "SYS_ALWAYS_ON");
	case EXPR_NOT:
		return path_of(l, node->left, !inverse);
	case EXPR_AND: case EXPR_OR:
		first = path_of(l, node->left, inverse);
		return both(l, (node->op == EXPR_AND) != inverse ? PATH_SERIES : PATH_PARALLEL, first,
			    path_of(l, node->right, inverse));
	case EXPR_XOR:
		return xor_of(l, node->left, node->right, inverse);
	case EXPR_CALL:
		is = word_of(l, at, &arg);
		if (is == FBD_RISING || is == FBD_FALLING)
			return edge_path(l, arg, is == FBD_RISING, inverse);
		if (is == FBD_PREVIOUS) {
			const struct expr_node *wire = node_of(l, arg);

			return cell(l, inverse ? "NC" : "NO",
				    text_of(l, networks_wire(&l->names, wire->text, wire->len, true)));
		}
		if (logic_of(l, node) != EXPR_CALL)
			return call_path(l, node, logic_of(l, node), inverse);
		break;
	case EXPR_FN: case EXPR_NEG: case EXPR_INDEX: case EXPR_ARG:
		break;
	}
	return prints(l, at, true) ? test_cell(l, at, inverse) : cell(l, inverse ? "NC" : "NO", execute_value(l, at));
}

/* ---- EXECUTE ---- */

static void execute_lines(struct ladders *l, const char *lines)
{
	heading(l);
	sink_printf(l->sink, "  | EXECUTE Net%d |\n  EXECUTE Net%d:\n%s  END_EXECUTE\n", l->names.network + 1,
		    l->names.network + 1, lines);
}

/* The item as Structured Text. */
static void execute(struct ladders *l, const struct st_item *item)
{
	struct sink_memory line, before;

	sink_memory_init(&line);
	sink_memory_init(&before);
	const struct sink to_line = sink_to_memory(&line), to_before = sink_to_memory(&before);

	networks_statement(&l->names, item, &to_line, &to_before);
	sink_text(&to_before, sink_memory_text(&line));
	l->acts->failed |= line.failed || before.failed;
	execute_lines(l, sink_memory_text(&before));
	sink_memory_free(&line);
	sink_memory_free(&before);
}

/* A value that can always be computed, in a BOOL. */
static const char *execute_value(struct ladders *l, int at)
{
	const char *temp = text_of(l, temp_new(l));
	struct sink_memory line;

	sink_memory_init(&line);
	const struct sink sink = sink_to_memory(&line);

	sink_printf(&sink, "%s := ", temp);
	print(l, at, &sink);
	sink_text(&sink, ";\n");
	l->acts->failed |= line.failed;
	execute_lines(l, sink_memory_text(&line));
	sink_memory_free(&line);
	return temp;
}

/* A condition that no contacts say, in a BOOL: FALSE if it cannot be computed. */
static const struct path *execute_condition(struct ladders *l, const char *text, size_t len)
{
	const char *temp = text_of(l, temp_new(l));
	struct sink_memory line, before;

	sink_memory_init(&line);
	sink_memory_init(&before);
	const struct sink to_line = sink_to_memory(&line), to_before = sink_to_memory(&before);

	sink_printf(&to_line, "%s := FALSE;\n%s := ", temp, temp);
	networks_text(&l->names, text, len, &to_line, &to_before);
	sink_text(&to_line, ";\n");
	sink_text(&to_before, sink_memory_text(&line));
	l->acts->failed |= line.failed || before.failed;
	execute_lines(l, sink_memory_text(&before));
	sink_memory_free(&line);
	sink_memory_free(&before);
	return cell(l, "NO", temp);
}

/* ---- lines ---- */

static const char *item_text(const struct ladders *l, const struct st_item *item, size_t *len)
{
	*len = names_len(&l->acts->project->names, item->text);
	return text_of(l, item->text);
}

static bool next_part(struct ladders *l, struct st_walk *walk, struct st_part *part)
{
	return st_next(walk, part, l->acts->expr, l->ignored, (struct diag){ .id = DIAG_COUNT }) &&
	       part->role != ST_NO_PART;
}

/* [ text ] of the expression, whose text this is: it passes no power if it cannot be computed. */
static const struct path *whole_cell(struct ladders *l, const char *text, size_t len)
{
	struct sink_memory memory;

	sink_memory_init(&memory);
	const struct sink sink = sink_to_memory(&memory);

	sink_text(&sink, "[ ");
	put_text(l, text, len, &sink);
	sink_text(&sink, " ]");
	return path_new(l, PATH_CELL, take_text(l, &memory));
}

/* The condition of a set, a jump or a RETURN, from @text on; NULL @text: always. */
static const struct path *condition(struct ladders *l, const char *text, size_t len)
{
	const int root = l->acts->expr->root;

	if (!text)
		return path_new(l, PATH_WIRE, 0);
	if (is_drawn(l, root))
		return path_of(l, root, false);
	if (fits_cell(l) && is_bool(l, root) && !has(l, root, true) && !has(l, root, false))
		return whole_cell(l, text, len);
	return execute_condition(l, text, len);
}

static void latch(struct ladders *l, const struct st_item *item)
{
	struct st_walk walk;
	struct st_part part;
	const struct path *path;
	const char *text, *operand;
	const struct expr_node *place_node;
	bool plain;
	size_t len;

	text = item_text(l, item, &len);
	st_begin(&walk, &l->acts->project->names, item);
	if (!next_part(l, &walk, &part))
		return;
	place_node = node_of(l, l->acts->expr->root);
	plain = place_node->op == EXPR_NAME && meaning_of(l, place_node);
	operand = plain ? name_text(l, place_node) : "";
	if (!plain || !next_part(l, &walk, &part)) {
		execute(l, item);
		return;
	}
	path = condition(l, part.text, len - (size_t)(part.text - text));
	put_rung(l, path, cell(l, item->kind == ST_SET ? "S" : "R", operand)->text, 0);
}

static void leave(struct ladders *l, const struct st_item *item)
{
	const struct token label = st_label_name(&l->acts->project->names, item);
	const bool stop = item->kind == ST_STOP_IF;
	const struct path *path;
	struct st_walk walk;
	struct st_part part;
	const char *text;
	bool given;
	size_t len;

	text = item_text(l, item, &len);
	st_begin(&walk, &l->acts->project->names, item);
	given = next_part(l, &walk, &part);
	path = condition(l, given ? part.text : NULL, given ? len - (size_t)(part.text - text) : 0);
	if (item->kind == ST_JUMP_IF)
		put_rung(l, path, cell(l, "JMP", text_of(l, acts_intern(l->acts, label.text, label.len)))->text, 0);
	else
		put_rung(l, path, acts_intern(l->acts, stop ? "STOP" : "RET", stop ? 4 : 3), 0);
}

/* ---- boxes ---- */

static void box_begin(struct box *box)
{
	*box = (struct box){ .branches = 0 };
	sink_memory_init(&box->text);
}

static void put_box(struct ladders *l, struct box *box)
{
	const uint32_t text = take_text(l, &box->text);
	int col = box->power ? box->power->width : 0, row = box->power ? box->power->height : 1;

	for (int i = 0; i < box->branches; i++)
		col = box->branch[i].path->width > col ? box->branch[i].path->width : col;
	heading(l);
	if (box->power) {
		place(l, box->power, 0, 0);
		fill(l, 0, box->power->width, col);
	}
	set(l, 0, col, text);
	if (box->after)
		place(l, box->after, 0, col + 1);
	put_coils(l, box->behind, box->coils, col + 1 + (box->after ? box->after->width : 0));
	for (int i = 0, at = 1; i < box->branches; i++) {
		const struct path *path = box->branch[i].path;
		char pin[LIMIT_NAME + 8];

		for (; at < row; at++)
			set(l, at, col, acts_intern(l->acts, ".", 1));
		place(l, path, row, 0);
		fill(l, row, path->width, col);
		snprintf(pin, sizeof(pin), ".%.*s", LIMIT_NAME, text_of(l, box->branch[i].pin));
		set(l, row, col, acts_intern(l->acts, pin, strlen(pin)));
		at = row + 1;
		row += path->height;
	}
	put_rows(l);
}

/* An operand that a box takes: a name or a constant, `/` before an inverse BOOL. False: it is none. */
static bool put_operand(struct ladders *l, int at, const struct sink *sink)
{
	const struct expr_node *node = node_of(l, at);
	const struct expr_node *inner = node->op == EXPR_NOT || node->op == EXPR_NEG ? node_of(l, node->left) : node;

	if (node->op == EXPR_NEG && inner->op == EXPR_LITERAL)
		sink_text(sink, "-");
	else if (node->op == EXPR_NEG || (node->op == EXPR_NOT && (inner->op == EXPR_LITERAL || !is_bool(l, at))))
		return false;
	if (inner->op != EXPR_LITERAL && !is_sure_name(l, inner))
		return false;
	sink_text(sink, node->op == EXPR_NOT ? "/" : "");
	if (inner->op == EXPR_LITERAL)
		put_text(l, inner->text, inner->len, sink);
	else
		sink_text(sink, name_text(l, inner));
	return true;
}

static bool takes_type(struct ladders *l, int at, enum iec_type pin)
{
	const enum iec_type type = infer_type(&l->infer, at);

	return type == IEC_NONE || type == pin || (type != IEC_BOOL && pin != IEC_BOOL && iec_can_widen(type, pin));
}

static bool mentions(struct ladders *l, const struct meaning *instance)
{
	for (int i = 0; i < l->acts->expr->count; i++) {
		const struct expr_node *node = node_of(l, i);
		const struct meaning *m = node->op == EXPR_NAME ? meaning_of(l, node) : NULL;

		if (m && m->kind != MEANING_LITERAL && m->var == instance->var)
			return true;
	}
	return false;
}

/* An input of a block: power, a branch or written at the box. False: the box cannot have it. @draw: else only
 * whether it can. */
static bool block_input(struct ladders *l, struct box *box, const struct word_row *row, const struct st_part *part,
			bool draw)
{
	const int pin = word_pin_find(row, part->pin.text, part->pin.len), root = l->acts->expr->root;
	const struct sink sink = sink_to_memory(&box->text);
	struct sink_memory none;

	const int first = word_first_bool(row, PIN_IN);
	const bool en = pin < 0 && first < 0 && ascii_is("EN", part->pin.text, part->pin.len);

	if (!en && (pin < 0 || pin >= row->pin_count))
		return false;
	if (en || pin == first) {
		if (draw)
			box->power = path_of(l, root, false);
		return is_drawn(l, root);
	}
	if (row->pin[pin].type == IEC_NONE ? infer_type(&l->infer, root) != IEC_NONE :
					    !takes_type(l, root, row->pin[pin].type))
		return false;
	sink_memory_init(&none);
	const struct sink nowhere = sink_to_memory(&none);

	if (put_operand(l, root, &nowhere)) {
		sink_memory_free(&none);
		if (!draw)
			return true;
		sink_text(&sink, " ");
		sink_write(&sink, part->pin.text, part->pin.len);
		sink_text(&sink, ":=");
		return put_operand(l, root, &sink);
	}
	sink_memory_free(&none);
	if (row->pin[pin].type != IEC_BOOL || row->pin[pin].dir != PIN_IN || !is_drawn(l, root))
		return false;
	if (draw && box->branches < LIMIT_ARGS)
		box->branch[box->branches++] = (struct branch){
			acts_intern(l->acts, part->pin.text, part->pin.len), path_of(l, root, false) };
	return true;
}

/* May the output that is stored at @node be one of those that are stored inverted before it? */
static bool is_inverted_place(struct ladders *l, const struct box *box, const struct expr_node *node)
{
	struct sink_memory memory;
	const char *text;
	bool found = false;

	if (!box->inversions)
		return false;
	sink_memory_init(&memory);
	const struct sink sink = sink_to_memory(&memory);

	sink_text(&sink, "=> ");
	sink_write(&sink, node->text, node->len);
	text = text_of(l, take_text(l, &memory));
	for (int i = 0; i < box->inversions; i++) {
		const char *place_text = text_of(l, box->inverted[i].place);
		const struct token name = { .kind = TOKEN_NAME, .text = place_text, .len = strlen(place_text) };

		found |= text_may_write(l->acts, text, &name);
	}
	return found;
}

/* NOT Q => Lamp becomes a coil behind the box. */
static bool inverted_output(struct ladders *l, struct box *box, const struct word_row *row, const struct st_part *part)
{
	const struct expr_node *node = node_of(l, l->acts->expr->root);
	const int pin = word_pin_find(row, part->pin.text, part->pin.len);

	if (pin < 0 || row->pin[pin].type != IEC_BOOL || word_first_bool(row, PIN_IN) < 0 || !draws(l, l->acts->expr->root) ||
	    box->inversions == WIDE)
		return false;
	box->inverted[box->inversions++] = (struct inverted){ acts_intern(l->acts, part->pin.text, part->pin.len),
							      acts_intern(l->acts, node->text, node->len) };
	return true;
}

static bool block_output(struct ladders *l, struct box *box, const struct word_row *row, const struct st_part *part,
			 bool draw)
{
	const struct expr_node *node = node_of(l, l->acts->expr->root);
	const struct sink sink = sink_to_memory(&box->text);

	if (node->op != EXPR_NAME || !is_sure_name(l, node) || part->pin.len == 0)
		return false;
	if (part->inverted)
		return inverted_output(l, box, row, part);
	if (is_inverted_place(l, box, node))
		return false;
	if (!draw)
		return true;
	sink_text(&sink, " ");
	sink_write(&sink, part->pin.text, part->pin.len);
	sink_text(&sink, "=>");
	put_text(l, node->text, node->len, &sink);
	return true;
}

/* Reads the parts of a call of an instance. */
static bool block_parts(struct ladders *l, struct box *box, const struct st_item *item, const struct word_row *row,
			const struct meaning *instance, bool draw)
{
	const int first = word_first_bool(row, PIN_IN);
	bool powered = false;
	struct st_walk walk;
	struct st_part part;
	int inputs = 0;

	box->inversions = 0;
	st_begin(&walk, &l->acts->project->names, item);
	if (!next_part(l, &walk, &part)) /* what is called */
		return false;
	while (next_part(l, &walk, &part)) {
		if (part.role == ST_OPEN)
			continue;
		if (part.role == ST_INPUT && (part.pin.len == 0 || (inputs++ && mentions(l, instance))))
			return false;
		if (part.role == ST_INPUT)
			powered |= word_pin_find(row, part.pin.text, part.pin.len) == first;
		if (part.role == ST_INPUT ? !block_input(l, box, row, &part, draw) : !block_output(l, box, row, &part, draw))
			return false;
	}
	return powered || first < 0;
}

/* Is the expression the first Boolean output of @instance? */
static bool is_power_of(struct ladders *l, int at, const struct meaning *instance, const struct word_row *row)
{
	const struct expr_node *node = node_of(l, at);
	const struct meaning *m = node->op == EXPR_NAME ? meaning_of(l, node) : NULL;
	const int out = word_first_bool(row, PIN_OUT);

	return m && out >= 0 && m->kind == MEANING_PIN && !m->opens && m->var == instance->var && m->pin == out &&
	       m->offset == instance->offset + row->pin[out].offset;
}

/* Contacts and comparisons: they need no rung before. */
static bool is_contacts(struct ladders *l, int at)
{
	const struct expr_node *node = node_of(l, at);

	switch (node->op) {
	case EXPR_NAME: case EXPR_BIT: case EXPR_LITERAL:
		return true;
	case EXPR_NOT:
		return is_contacts(l, node->left);
	case EXPR_AND: case EXPR_OR:
		return !node->lazy && is_contacts(l, node->left) && is_contacts(l, node->right);
	case EXPR_FN:
		return prints(l, at, true);
	case EXPR_XOR: case EXPR_CALL: case EXPR_NEG: case EXPR_INDEX: case EXPR_ARG:
		break;
	}
	return false;
}

/* How many cells is_contacts() has, at most. */
static int contact_count(struct ladders *l, int at)
{
	const struct expr_node *node = node_of(l, at);

	if (node->op == EXPR_NOT)
		return contact_count(l, node->left);
	return node->op == EXPR_AND || node->op == EXPR_OR ? contact_count(l, node->left) + contact_count(l, node->right) : 1;
}

/* Have they room behind the box and before a coil? No value of them may be kept aside: that rung would stand before the
 * box. */
static bool has_room_behind(struct ladders *l, const struct box *box, int at)
{
	const int count = contact_count(l, at) - 1, col = box->power ? box->power->width + 1 : 1;

	return count <= WIDE && col + count < LIMIT_COLS;
}

/* Delay.Q AND … of the power behind the block. */
static bool goes_on(struct ladders *l, int at, const struct meaning *instance, const struct word_row *row)
{
	const struct expr_node *node = node_of(l, at);

	return node->op == EXPR_AND && !node->lazy && is_contacts(l, node->right) &&
	       (is_power_of(l, node->left, instance, row) || goes_on(l, node->left, instance, row));
}

/* The path of that without the power. */
static const struct path *path_behind(struct ladders *l, int at, const struct meaning *instance, const struct word_row *row)
{
	const struct expr_node *node = node_of(l, at);
	const struct path *first = is_power_of(l, node->left, instance, row) ? NULL :
				   path_behind(l, node->left, instance, row);
	const struct path *second = path_of(l, node->right, false);

	return first ? both(l, PATH_SERIES, first, second) : second;
}

/* The coil of a line that stores a BOOL, and the value, which is the root then; 0: it is another line. */
static uint32_t coil_of(struct ladders *l, const struct st_item *item)
{
	const struct expr *expr = l->acts->expr;
	const struct meaning *target;
	const char *word = "COIL", *operand;
	struct st_walk walk;
	struct st_part part;

	st_begin(&walk, &l->acts->project->names, item);
	if (item->kind == ST_ASSIGN) {
		if (!next_part(l, &walk, &part) || walk.stores > 0 || !expr->target || expr->target_points ||
		    expr->target_tried || expr->target_index >= 0 || expr->target_bit.len)
			return 0;
		target = acts_meaning(l->acts, acts_intern(l->acts, expr->target, expr->target_len));
		if (!target)
			return 0;
		operand = text_with_wires(l, expr->target, expr->target_len);
	} else if (item->kind == ST_SET || item->kind == ST_RESET) {
		const struct expr_node *place_node;

		if (!next_part(l, &walk, &part))
			return 0;
		place_node = node_of(l, expr->root);
		target = meaning_of(l, place_node);
		operand = target ? name_text(l, place_node) : "";
		word = item->kind == ST_SET ? "S" : "R";
		if (!target || !next_part(l, &walk, &part))
			return 0;
	} else {
		return 0;
	}
	return target->type != IEC_BOOL || meaning_is_whole(target) || target->through ? 0 : cell(l, word, operand)->text;
}

static void add_comment(struct ladders *l, const char *text, size_t len)
{
	struct sink_memory memory;

	sink_memory_init(&memory);
	const struct sink sink = sink_to_memory(&memory);

	if (l->comment)
		sink_printf(&sink, "%s\n", text_of(l, l->comment));
	sink_write(&sink, text, len);
	l->comment = take_text(l, &memory);
}

static void add_inside(struct ladders *l, const struct st_item *item)
{
	size_t len, found;
	const char *text = item_text(l, item, &len);

	for (size_t at = 0; item->kind != ST_COMMENT && (found = networks_comment(text, len, &at)) > 0; at += found)
		add_comment(l, text + at, found);
}

/* The line behind the one that is *by lines below that in work; NULL: there is none. Comments are passed. */
static const struct st_item *line_behind(const struct ladders *l, int *by)
{
	const int end = l->network->first + l->network->count - l->names.item;

	while (++*by < end)
		if (l->acts->pou->st->item[l->names.item + *by].kind != ST_COMMENT)
			return &l->acts->pou->st->item[l->names.item + *by];
	return NULL;
}

/* So many lines more stand in the rung. Their comments stand above it. */
static void take_lines(struct ladders *l, int count)
{
	for (int i = 1; i <= count; i++) {
		const struct st_item *item = &l->acts->pou->st->item[l->names.item + i];
		size_t len;
		const char *text = item_text(l, item, &len);

		if (item->kind == ST_COMMENT)
			add_comment(l, text, len);
		else
			add_inside(l, item);
	}
	l->skip = count;
}

static uint32_t inverse_coil(struct ladders *l, uint32_t coil)
{
	return cell(l, "COILNOT", text_of(l, coil) + strlen("COIL "))->text;
}

/* Are all inverted outputs the power behind the block, with room for their coils? */
static bool inverts_power(const struct ladders *l, const struct box *box, const struct word_row *row)
{
	const int first = word_first_bool(row, PIN_OUT);

	for (int i = 0; i < box->inversions; i++) {
		const char *pin = text_of(l, box->inverted[i].pin);

		if (word_pin_find(row, pin, strlen(pin)) != first)
			return false;
	}
	return box->inversions <= (box->branches ? 1 : WIDE);
}

/* Outputs that are stored inverted, in the rung of the box. */
static void inverse_coils(struct ladders *l, struct box *box)
{
	for (int i = 0; i < box->inversions; i++) {
		const char *operand = text_of(l, box->inverted[i].place);

		box->behind[box->coils++] = cell(l, "COILNOT", text_with_wires(l, operand, strlen(operand)))->text;
	}
}

/* The same in rungs behind it. */
static void inverse_rungs(struct ladders *l, const struct box *box, const char *instance)
{
	for (int i = 0; i < box->inversions; i++) {
		const char *operand = text_of(l, box->inverted[i].place);
		struct sink_memory memory;

		sink_memory_init(&memory);
		const struct sink sink = sink_to_memory(&memory);

		sink_printf(&sink, "%s.%s", instance, text_of(l, box->inverted[i].pin));
		put_rung(l, cell(l, "NC", text_of(l, take_text(l, &memory))),
			 cell(l, "COIL", text_with_wires(l, operand, strlen(operand)))->text, 0);
	}
}

/* The coils of the lines behind a call that store the power behind the block alone. A row of a pin has no room. */
static void coils_behind(struct ladders *l, struct box *box, const struct meaning *instance, const struct word_row *row)
{
	const struct st_item *item;
	int by = 0, last = 0;

	while (word_first_bool(row, PIN_IN) >= 0 && box->coils < (box->branches ? 1 : WIDE) &&
	       (item = line_behind(l, &by)) != NULL) {
		const uint32_t coil = coil_of(l, item);
		const int root = l->acts->expr->root;
		const struct expr_node *node = node_of(l, root);
		const bool inverse = coil && item->kind == ST_ASSIGN && node->op == EXPR_NOT &&
				     is_power_of(l, node->left, instance, row);
		const bool more = coil && !box->coils && !box->branches && is_drawn(l, root) && goes_on(l, root, instance, row) &&
				  has_room_behind(l, box, root);

		if (!coil || (!more && !inverse && !is_power_of(l, root, instance, row)))
			break;
		if (more)
			box->after = path_behind(l, root, instance, row);
		box->behind[box->coils++] = inverse ? inverse_coil(l, coil) : coil;
		last = by;
		if (more)
			break;
	}
	take_lines(l, last);
}

/* ---- one value for several coils ---- */

/* How many lines of the network read the wire; other uses count as many. */
static int readers_of(struct ladders *l, const char *name, size_t len)
{
	int count = 0;

	for (int i = 0; i < l->network->count; i++) {
		struct fbd_names walk;
		struct token token;
		enum fbd_use use;
		bool whole;

		fbd_names_begin(&walk, &l->acts->project->names, &l->acts->pou->st->item[l->network->first + i]);
		while (fbd_names_next(&walk, &token, &use, &whole))
			if (name_same(token.text, token.len, name, len) && use != FBD_WRITTEN)
				count += use == FBD_READ && whole ? 1 : LIMIT_ROWS;
	}
	return count;
}

/* Wire := value, and lines below that store the wire alone, which nothing else reads: one rung. */
static bool share(struct ladders *l, const struct st_item *item)
{
	const struct expr *expr = l->acts->expr;
	const struct st_item *reader;
	const struct path *path;
	uint32_t coil[WIDE];
	struct st_walk walk;
	struct st_part part;
	const char *wire;
	size_t len;
	int count = 0, by = 0, last = 0;

	st_begin(&walk, &l->acts->project->names, item);
	if (!next_part(l, &walk, &part) || walk.stores > 0 || !expr->target || expr->target_points || expr->target_tried ||
	    expr->target_index >= 0 || expr->target_bit.len || !is_drawn(l, expr->root))
		return false;
	wire = expr->target;
	len = expr->target_len;
	if (fbd_wire(&l->acts->project->names, l->acts->pou, l->names.network, wire, len) < 0)
		return false;
	while (count < WIDE && (reader = line_behind(l, &by)) != NULL) {
		const uint32_t one = coil_of(l, reader);
		const struct expr_node *value = node_of(l, expr->root);

		if (!one || value->op != EXPR_NAME || !name_same(value->text, value->len, wire, len))
			break;
		coil[count++] = one;
		last = by;
	}
	if (count < 2 || readers_of(l, wire, len) != count)
		return false;
	st_begin(&walk, &l->acts->project->names, item);
	if (!next_part(l, &walk, &part))
		return false;
	path = path_of(l, expr->root, false);
	take_lines(l, last);
	heading(l);
	place(l, path, 0, 0);
	put_coils(l, coil, count, path->width);
	put_rows(l);
	return true;
}

static void call(struct ladders *l, const struct st_item *item)
{
	const struct meaning *m;
	const struct expr_node *node;
	const struct word_row *row;
	const struct pou *pou;
	struct box *box = arena_alloc(l->acts->arena, sizeof(*box));
	const char *instance = "";
	struct st_walk walk;
	struct st_part part;
	bool same_rung;

	st_begin(&walk, &l->acts->project->names, item);
	if (!box || !next_part(l, &walk, &part)) {
		l->acts->failed |= !box;
		return;
	}
	node = node_of(l, l->acts->expr->root);
	m = node->op == EXPR_NAME ? meaning_of(l, node) : NULL;
	pou = node->op == EXPR_NAME && !m ? scope_pou(l->acts->scope, l->acts->pou,
						      acts_intern(l->acts, node->text, node->len)) : NULL;
	if (pou && pou->kind == POU_SUBROUTINE) {
		put_rung(l, path_new(l, PATH_WIRE, 0), cell(l, "CALL", text_of(l, pou->name))->text, 0);
		return;
	}
	row = m && m->kind == MEANING_INSTANCE && !m->opens && !m->through ?
	      words_row(&l->acts->project->words, (enum word)m->word) : NULL;
	box_begin(box);
	if (!row || m->action || !block_parts(l, box, item, row, m, false)) {
		sink_memory_free(&box->text);
		execute(l, item);
		return;
	}
	const struct sink sink = sink_to_memory(&box->text);

	sink_printf(&sink, "%s ", row->word);
	st_begin(&walk, &l->acts->project->names, item);
	if (next_part(l, &walk, &part)) {
		node = node_of(l, l->acts->expr->root);
		instance = text_with_wires(l, node->text, node->len);
		sink_text(&sink, instance);
	}
	block_parts(l, box, item, row, m, true);
	same_rung = inverts_power(l, box, row);
	if (same_rung) {
		inverse_coils(l, box);
		coils_behind(l, box, m, row);
	}
	put_box(l, box);
	if (!same_rung)
		inverse_rungs(l, box, instance);
}

/* ---- functions as boxes ---- */

/* Does the argument have the type that the box works with? */
static bool fits_box_input(struct ladders *l, const struct word_row *row, int pin, int at, enum iec_type target)
{
	const struct word_pin *row_pin = word_input(row, (uint32_t)pin);
	const enum iec_type type = infer_type(&l->infer, at), wanted = row_pin->type ? row_pin->type : target;
	struct literal literal;
	union iec_value value;

	if (is_constant(l, at) && row_pin->type == IEC_NONE && type == IEC_NONE) {
		const struct expr_node *node = node_of(l, at);

		return node->op == EXPR_LITERAL && literal_parse(node->text, node->len, &literal) == LITERAL_OK &&
		       literal_fit(&literal, target, &value);
	}
	return type == wanted || (row_pin->type && type == IEC_NONE && is_constant(l, at));
}

static bool fits_box_place(struct ladders *l, int at)
{
	const struct expr_node *node = node_of(l, at);
	const struct meaning *m = node->op == EXPR_NAME ? meaning_of(l, node) : NULL;

	return m && !m->opens && !m->through;
}

/* x := F(EN := …, ENO => …) of a function of the catalogue whose inputs are operands of one type. */
static bool fits_box(struct ladders *l, const struct meaning *target, const struct expr_args *args,
		     const struct word_row *row)
{
	struct sink_memory none;
	bool good = !meaning_is_whole(target) && target->type != IEC_NONE && target->type != IEC_STRING &&
		    !meaning_is_checked(target) && args->count > 0;

	sink_memory_init(&none);
	const struct sink nowhere = sink_to_memory(&none);

	for (int i = 0; good && i < args->count; i++)
		good = fits_box_input(l, row, args->arg[i].pin, args->arg[i].at, target->type) &&
		       put_operand(l, args->arg[i].at, &nowhere);
	sink_memory_free(&none);
	for (int i = 0; good && i < args->more; i++)
		good = args->other[i].pin == EXPR_EN ? is_drawn(l, args->other[i].at) :
		       args->other[i].pin == EXPR_ENO && !args->other[i].inverted && fits_box_place(l, args->other[i].at);
	return good;
}

/* The power behind a test, and behind AND OR XOR NOT of BOOLs, is its result, not ENO. */
static bool gates(const struct word_row *row, const struct meaning *target)
{
	return word_is_test(row) || target->type == IEC_BOOL;
}

static bool function(struct ladders *l, const struct meaning *target, const char *place_text)
{
	const struct expr_node *root = node_of(l, l->acts->expr->root);
	const enum word word = function_of(l, root);
	const struct word_row *row = word != WORD_COUNT ? words_row(&l->acts->project->words, word) : NULL;
	struct expr_args *args = arena_alloc(l->acts->arena, sizeof(*args));
	struct box *box = arena_alloc(l->acts->arena, sizeof(*box));
	const struct expr_node *place_node;

	if (!row || !args || !box || expr_match(l->acts->expr, root, row, args) != DIAG_COUNT ||
	    !fits_box(l, target, args, row))
		return false;
	box_begin(box);
	const struct sink sink = sink_to_memory(&box->text);

	sink_text(&sink, row->word);
	for (int i = 0; i < args->count; i++) {
		char pin[LIMIT_NAME + 8];

		expr_pin_name(row, args->arg[i].pin, pin, sizeof(pin));
		sink_printf(&sink, " %s:=", pin);
		put_operand(l, args->arg[i].at, &sink);
	}
	sink_printf(&sink, " OUT=>%s", place_text);
	for (int i = 0; i < args->more; i++) {
		if (args->other[i].pin == EXPR_EN) {
			box->power = path_of(l, args->other[i].at, false);
			continue;
		}
		place_node = node_of(l, args->other[i].at);
		if (gates(row, target)) {
			sink_text(&sink, " ENO=>");
			put_text(l, place_node->text, place_node->len, &sink);
		} else {
			box->behind[box->coils++] = cell(l, "COIL", name_text(l, place_node))->text;
		}
	}
	put_box(l, box);
	return true;
}

/* Does a cell store the value as the statement does? */
static bool stores_alike(struct ladders *l, const struct meaning *target)
{
	const int root = l->acts->expr->root;
	const enum iec_type type = infer_type(&l->infer, root);

	if (!target || mixed_is_bits(target->type) || has(l, root, true))
		return false;
	if (type == IEC_NONE)
		return is_constant(l, root) || meaning_is_whole(target);
	return (type == IEC_BOOL) == (target->type == IEC_BOOL) && (type == target->type || iec_can_widen(type, target->type));
}

/* Can only the last of its functions fail? Then its edges are computed each time. */
static bool is_sure_inside(struct ladders *l, int at)
{
	const struct expr_node *node = node_of(l, at);

	if (is_sure(l, at))
		return true;
	if (node->op == EXPR_FN)
		return is_sure(l, node->left) && is_sure(l, node->right);
	if (function_of(l, node) == WORD_COUNT)
		return false;
	for (int i = node->left; i >= 0; i = node_of(l, i)->right)
		if (node_of(l, i)->output || !is_sure(l, node_of(l, i)->left))
			return false;
	return true;
}

/* [ target := value ] of a value with edges, which stand in rungs before. */
static bool assign_edges(struct ladders *l, const char *place_text)
{
	const int root = l->acts->expr->root;
	struct sink_memory memory;
	bool fits;

	l->edges = true;
	fits = is_sure_inside(l, root) && prints(l, root, true);
	l->edges = false;
	if (!fits)
		return false;
	sink_memory_init(&memory);
	const struct sink sink = sink_to_memory(&memory);

	sink_printf(&sink, "[ %s := ", place_text);
	print(l, root, &sink);
	sink_text(&sink, " ]");
	put_rung(l, path_new(l, PATH_WIRE, 0), take_text(l, &memory), 0);
	return true;
}

static void assign(struct ladders *l, const struct st_item *item)
{
	const struct expr *expr = l->acts->expr;
	const struct meaning *target;
	const char *text, *place_text;
	struct st_walk walk;
	struct st_part part;
	size_t len;
	int root;

	text = item_text(l, item, &len);
	st_begin(&walk, &l->acts->project->names, item);
	if (!next_part(l, &walk, &part) || walk.stores > 0 || !expr->target || expr->target_points ||
	    expr->target_tried || expr->target_index >= 0 || expr->target_bit.len) {
		execute(l, item);
		return;
	}
	root = expr->root;
	target = acts_meaning(l->acts, acts_intern(l->acts, expr->target, expr->target_len));
	place_text = text_with_wires(l, expr->target, expr->target_len);
	if (target && target->type == IEC_BOOL && !meaning_is_whole(target) && !target->through && is_drawn(l, root)) {
		const struct path *path = path_of(l, root, false);

		put_rung(l, path, cell(l, "COIL", place_text)->text, 0);
		return;
	}
	if (target && function(l, target, place_text))
		return;
	if (stores_alike(l, target) && has(l, root, false) && assign_edges(l, place_text))
		return;
	if (!stores_alike(l, target) || !fits_cell(l)) {
		execute(l, item);
		return;
	}
	put_rung(l, path_new(l, PATH_WIRE, 0), whole_cell(l, text, len)->text, 0);
}

/* ---- networks ---- */

static void put_item(struct ladders *l, const struct st_item *item)
{
	size_t len;
	const char *text = item_text(l, item, &len);

	add_inside(l, item);
	switch ((enum st_kind)item->kind) {
	case ST_COMMENT:
		add_comment(l, text, len);
		break;
	case ST_ASSIGN:
		if (!share(l, item))
			assign(l, item);
		break;
	case ST_CALL:
		call(l, item);
		break;
	case ST_SET: case ST_RESET:
		latch(l, item);
		break;
	case ST_JUMP_IF: case ST_RETURN_IF: case ST_STOP_IF:
		leave(l, item);
		break;
	case ST_IF: case ST_ELSIF: case ST_ELSE: case ST_END_IF: case ST_CASE: case ST_CHOICE: case ST_END_CASE:
	case ST_FOR: case ST_END_FOR: case ST_WHILE: case ST_END_WHILE: case ST_REPEAT: case ST_UNTIL: case ST_EXIT:
	case ST_CONTINUE: case ST_RETURN: case ST_JUMP: case ST_LABEL: case ST_EMPTY: case ST_KINDS:
		break;
	}
}

/* Lines of a network that is OFF, as comments. */
static void put_off(struct ladders *l)
{
	for (int i = 0; i < l->network->count; i++) {
		const struct st_item *item = &l->acts->pou->st->item[l->network->first + i];
		size_t len;
		const char *text = item_text(l, item, &len);

		while (len) {
			const char *end = memchr(text, '\n', len);
			const size_t line = end ? (size_t)(end - text) : len;
			struct sink_memory memory;

			sink_memory_init(&memory);
			const struct sink sink = sink_to_memory(&memory);

			sink_text(&sink, "// ");
			sink_write(&sink, text, line);
			add_comment(l, sink_memory_text(&memory), memory.len);
			sink_memory_free(&memory);
			text += line + (end != NULL);
			len -= line + (end != NULL);
		}
	}
}

/* Sum_before := Sum of each wire that PREVIOUS names. */
static void put_kept(struct ladders *l)
{
	uint32_t before, wire;
	enum iec_type type;
	int at = 0;

	while (networks_kept(&l->names, &at, &before, &wire, &type)) {
		const char *to = text_of(l, before), *from = text_of(l, wire);
		struct sink_memory memory;

		if (type == IEC_BOOL) {
			put_rung(l, cell(l, "NO", from), cell(l, "COIL", to)->text, 0);
			continue;
		}
		sink_memory_init(&memory);
		const struct sink sink = sink_to_memory(&memory);

		sink_printf(&sink, "[ %s := %s ]", to, from);
		put_rung(l, path_new(l, PATH_WIRE, 0), take_text(l, &memory), 0);
	}
}

static void put_network(struct ladders *l, int number)
{
	struct acts *acts = l->acts;
	struct st_item *item = acts->pou->st->item + acts->pou->fbd->network[number].first;
	const void *was;

	l->network = &acts->pou->fbd->network[number];
	l->names.network = acts->rung = number;
	l->begun = false;
	scope_network(acts->scope, acts->pou, number);
	if (l->network->off) {
		if (l->network->label && networks_lead(&l->names, l->network->label))
			sink_printf(l->sink, "RUNG %s\n", text_of(l, l->network->label));
		put_off(l);
	} else {
		put_kept(l);
		was = arena_copy(acts->arena, (const char *)item, sizeof(*item) * (size_t)l->network->count);
		if (was)
			networks_join(acts, number, item, l->network->count);
		for (int i = 0; i < l->network->count; i++) {
			l->names.item = l->network->first + i;
			if (l->skip) {
				l->skip--;
				continue;
			}
			put_item(l, &acts->pou->st->item[l->names.item]);
		}
		if (was && l->network->count) /* the project stays as it was */
			memcpy(item, was, sizeof(*item) * (size_t)l->network->count);
		acts->failed |= !was;
	}
	if (!l->begun || l->comment)
		heading(l);
	scope_network(acts->scope, acts->pou, -1);
}

bool fbd_ladder(struct acts *acts, const struct sink *sink)
{
	struct ladders *l = arena_alloc(acts->arena, sizeof(*l));
	struct sink_memory memory;

	if (l) {
		l->cell = arena_alloc(acts->arena, sizeof(*l->cell) * LIMIT_ROWS);
		l->link = arena_alloc(acts->arena, sizeof(*l->link) * LIMIT_ROWS);
		l->ignored = arena_alloc(acts->arena, sizeof(*l->ignored));
	}
	if (!l || !l->cell || !l->link || !l->ignored) {
		acts->failed = true;
		return false;
	}
	sink_memory_init(&memory);
	const struct sink body = sink_to_memory(&memory);

	l->acts = acts;
	l->sink = &body;
	l->no_path.height = 1;
	l->names.acts = acts;
	l->names.scoped = true;
	l->infer = (struct infer){ .scope = acts->scope, .pou = acts->pou, .project = acts->project,
				   .expr = acts->expr, .statement = true };
	for (int i = 0; i < acts->pou->fbd->count && !acts->failed; i++)
		put_network(l, i);
	networks_declare(&l->names, sink);
	st_declare(acts, sink);
	sink_text(sink, sink_memory_text(&memory));
	acts->failed |= memory.failed;
	sink_memory_free(&memory);
	return !acts->failed && !acts->refused;
}
