/* SPDX-License-Identifier: MIT
 *
 * compare - two projects compared: POUs, variables, rungs, lists, charts,
 * configuration.
 *
 * The canonical texts are compared last, to report differences that no part finds, such
 * as another order of declarations.
 */
#include "engine/compare/compare.h"
#include "engine/base/name.h"

#include "engine/base/limits.h"
#include "engine/base/plain.h"
#include "engine/base/sink.h"
#include "engine/compare/diff_match.h"
#include "engine/model/args.h"
#include "engine/model/fbd.h"
#include "engine/model/project.h"
#include "engine/text/pou_print.h"
#include "engine/text/text.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#define DIFF_CANDIDATES 64   /* rungs of a gap compared by likeness           */

struct diff {
	const struct project *a, *b;
	const struct sink *sink;
	bool json;
	bool failed;               /* memory is out                           */
	bool besides;              /* rungs and lines are counted but not printed */
	const char *pou;           /* and other POUs are skipped; NULL: print all */
	enum compare_group group;  /* of the differences to come              */
	int count;                 /* differences so far                      */
	int said;                  /* those in printed lines                  */
	struct arena arena;        /* scratch                                 */
	struct names names;        /* strings of both projects, by one id     */
	struct sink_memory bytes;  /* scratch: a rung or line made comparable */
	char from[1024], to[1024]; /* scratch: texts of two cells, lines, types */
	char subject[2 * LIMIT_NAME], pin[LIMIT_NAME + 1]; /* scratch: names  */
	/* Gets pairs of rungs; NULL: differences are printed. */
	void (*take)(void *context, struct compare_pair pair);
	void (*take_line)(void *context, struct compare_line line); /* gets pairs of lines */
	/* Gets differences instead of their being printed. */
	void (*take_difference)(void *context, const struct compare_difference *what);
	void *context;
	struct compare_pair pair;     /* for take: indices of its POUs            */
};

/* @count elements, at least one. NULL and diff->failed: memory is out. */
static void *diff_alloc(struct diff *diff, int count, size_t size)
{
	void *memory = arena_alloc(&diff->arena, (size_t)(count + 1) * size);

	if (!memory)
		diff->failed = true;
	return memory;
}

/* One id for the same bytes; 0 and diff->failed: memory is out. */
static uint32_t diff_id(struct diff *diff, const char *text, size_t len)
{
	uint32_t id = len ? names_intern(&diff->names, text, len) : 0;

	if (len > 0 && id == 0)
		diff->failed = true;
	if (diff->bytes.failed)
		diff->failed = true;
	return id;
}

/* One id for all spellings of a name, the same for both projects. */
static uint32_t diff_name(struct diff *diff, const char *name)
{
	uint32_t id = diff_id(diff, name, strlen(name));
	uint32_t fold = id ? names_fold(&diff->names, id) : 0;

	if (id && !fold)
		diff->failed = true;
	return fold;
}

/* ---- variables ---- */

#define TYPE_TEXT (LIMIT_NAME + 64)

/* The declared type: ARRAY[1..3] OF STRING[20]. */
static const char *type_text(const struct project *project,
			     const struct var *var, char room[TYPE_TEXT])
{
	struct sink_memory memory;
	struct sink sink;

	sink_memory_init(&memory);
	sink = sink_to_memory(&memory);
	project_write_type(project, var, &sink);
	snprintf(room, TYPE_TEXT, "%s", sink_memory_text(&memory));
	sink_memory_free(&memory);
	return room;
}

static const char *kept_text(uint16_t flags)
{
	static const char *const text[] = { "", "RETAIN", "CONSTANT",
					    "RETAIN CONSTANT" };

	return text[flags & (VAR_RETAIN | VAR_CONSTANT)];
}

/* "" for a plain VAR; VAR_GLOBAL is not repeated. */
static const char *flags_text(uint16_t flags)
{
	static const uint8_t kinds = VAR_INPUT | VAR_OUTPUT | VAR_IN_OUT | VAR_TEMP;

	if (flags & kinds && !(flags & VAR_RETAIN))
		return vars_head(flags & kinds);
	if (flags & VAR_INPUT)
		return "VAR_INPUT RETAIN";
	if (flags & VAR_OUTPUT)
		return "VAR_OUTPUT RETAIN";
	return kept_text(flags);
}

static const char *init_text(const struct project *project,
			     const struct var *var)
{
	return var->has_init ? project_text(project, var->init_text) : "";
}

#define SAY_CLIP 72 /* columns of one side of a change */

static void say_clipped(const struct sink *sink, const char *text)
{
	size_t len = strlen(text);
	int width;
	size_t fits = plain_clip(text, len, SAY_CLIP, &width);

	plain_write(sink, text, fits);
	if (fits < len)
		sink_text(sink, "…");
}

static void say_side(const struct sink *sink, const char *text)
{
	if (*text)
		say_clipped(sink, text);
	else
		sink_text(sink, "nothing");
}

/* A word of the place, with a blank before all but the first. */
static void say_word(const struct sink *sink, const char **gap,
		     const char *word)
{
	if (!word || !*word)
		return;
	sink_text(sink, *gap);
	say_clipped(sink, word);
	*gap = " ";
}

static void say_place(const struct sink *sink, const struct compare_difference *what)
{
	const char *gap = "";

	say_word(sink, &gap, what->pou);
	if (what->rung) {
		sink_printf(sink, "%srung %d", gap, what->rung);
		gap = " ";
		if (what->label && *what->label) {
			sink_text(sink, " (");
			say_clipped(sink, what->label);
			sink_text(sink, ")");
		}
	}
	if (what->row) {
		sink_printf(sink, "%scell (%d,%d)", gap, what->row, what->col);
		gap = " ";
	}
	if (what->line) {
		sink_printf(sink, "%sline %d", gap, what->line);
		gap = " ";
	}
	say_word(sink, &gap, what->kind);
	say_word(sink, &gap, what->subject);
}

static void say_words(const struct sink *sink, const struct compare_difference *what)
{
	say_place(sink, what);
	sink_text(sink, ": ");
	if (what->property)
		sink_printf(sink, "%s ", what->property);
	if (what->change) {
		sink_text(sink, what->change);
	} else {
		say_side(sink, what->from);
		sink_text(sink, " -> ");
		say_side(sink, what->to);
	}
	sink_text(sink, "\n");
}

static void json_number(const struct sink *sink, const char **gap,
			const char *name, int number)
{
	if (number) {
		sink_printf(sink, "%s\"%s\": %d", *gap, name, number);
		*gap = ", ";
	}
}

static void json_field(const struct sink *sink, const char **gap,
		       const char *name, const char *text)
{
	if (text) {
		sink_printf(sink, "%s\"%s\": ", *gap, name);
		sink_json_text(sink, text);
		*gap = ", ";
	}
}

static void say_json(const struct sink *sink, const struct compare_difference *what)
{
	const char *gap = "";

	sink_text(sink, "{");
	json_field(sink, &gap, "pou", what->pou);
	json_number(sink, &gap, "rung", what->rung);
	if (what->label && *what->label)
		json_field(sink, &gap, "label", what->label);
	json_number(sink, &gap, "row", what->row);
	json_number(sink, &gap, "col", what->col);
	json_number(sink, &gap, "line", what->line);
	json_field(sink, &gap, "kind", what->kind);
	json_field(sink, &gap, "subject", what->subject);
	json_field(sink, &gap, "property", what->property);
	json_field(sink, &gap, "change",
		   what->change ? what->change : "changed");
	json_field(sink, &gap, "from", what->from);
	json_field(sink, &gap, "to", what->to);
	sink_text(sink, "}");
}

/* Whether a difference is printed: not one that the caller draws, nor one of another
 * POU. */
static bool is_wanted(const struct diff *diff, const struct compare_difference *what)
{
	const char *pou = what->pou ? what->pou : what->subject ? what->subject : "";

	return !diff->besides || (!what->rung && !what->line &&
				  (!diff->pou || name_is(diff->pou, pou, strlen(pou))));
}

static void give_difference(struct diff *diff, struct compare_difference what)
{
	what.group = diff->group;
	diff->take_difference(diff->context, &what);
}

/* Prints and counts a difference. */
static void diff_say(struct diff *diff, const struct compare_difference *what)
{
	if (!is_wanted(diff, what)) {
		diff->count++;
		return;
	}
	diff->said++;
	if (diff->take_difference) {
		give_difference(diff, *what);
	} else if (diff->json) {
		sink_text(diff->sink, diff->count ? ",\n " : "\n ");
		say_json(diff->sink, what);
	} else {
		say_words(diff->sink, what);
	}
	diff->count++;
}

/* Adds difference @what if the texts differ, as from and to. */
static void diff_texts(struct diff *diff, struct compare_difference what, const char *property,
		       const char *from, const char *to)
{
	if (strcmp(from, to) == 0)
		return;
	what.property = property;
	what.from = from;
	what.to = to;
	diff_say(diff, &what);
}

static void compare_ids(struct diff *diff, struct compare_difference what,
			const char *property, uint32_t a, uint32_t b)
{
	diff_texts(diff, what, property, project_text(diff->a, a),
		   project_text(diff->b, b));
}

static void compare_var(struct diff *diff, struct compare_difference what,
			const struct var_table *a, int i,
			const struct var_table *b, int j)
{
	const struct var *x = &a->var[i], *y = &b->var[j];
	compare_ids(diff, what, "name", x->name, y->name);
	diff_texts(diff, what, "type", type_text(diff->a, x, diff->from),
		   type_text(diff->b, y, diff->to));
	compare_ids(diff, what, "address", x->at_text, y->at_text);
	diff_texts(diff, what, "initial value", init_text(diff->a, x),
		   init_text(diff->b, y));
	diff_texts(diff, what, "block", flags_text(vars_flags(a, i)),
		   flags_text(vars_flags(b, j)));
	compare_ids(diff, what, "comment", x->comment, y->comment);
}

/* Folded names of a table, and the index of each. */
static uint32_t *var_names(struct diff *diff, const struct project *project,
			   const struct var_table *table)
{
	const int count = vars_declared(table);
	uint32_t *name = diff_alloc(diff, count, sizeof(*name));

	for (int i = 0; name && i < count; i++)
		name[i] = diff_name(diff, project_text(project, table->var[i].name));
	return name;
}

static int *var_index(struct diff *diff, const uint32_t *name, int count)
{
	int *index = diff_alloc(diff, diff->names.count, sizeof(*index));

	for (int i = count - 1; index && i >= 0; i--)
		index[name[i]] = i + 1;
	return index;
}

static void compare_vars(struct diff *diff, const char *pou,
			 const struct var_table *a, const struct var_table *b)
{
	struct compare_difference what = { .pou = pou, .kind = "variable" };
	uint32_t *name_a = var_names(diff, diff->a, a);
	uint32_t *name_b = var_names(diff, diff->b, b);

	if (diff->failed)
		return;
	const int a_count = vars_declared(a), b_count = vars_declared(b);
	int *in_a = var_index(diff, name_a, a_count);
	int *in_b = var_index(diff, name_b, b_count);
	for (int i = 0; !diff->failed && i < a_count; i++) {
		what.subject = project_text(diff->a, a->var[i].name);
		what.change = in_b[name_a[i]] ? NULL : "removed";
		if (what.change)
			diff_say(diff, &what);
		else
			compare_var(diff, what, a, i, b, in_b[name_a[i]] - 1);
	}
	what.change = "added";
	for (int j = 0; !diff->failed && j < b_count; j++)
		if (!in_a[name_b[j]]) {
			what.subject = project_text(diff->b, b->var[j].name);
			diff_say(diff, &what);
		}
}

/* Comments above VAR blocks: the first VAR_INPUT of one table with the first of the other, and so
 * on. */
static uint32_t nth_block(const struct var_table *table, uint16_t flags, int n, bool *found)
{
	*found = false;
	for (int i = 0; i < table->block_count; i++)
		if (table->block[i].flags == flags && n-- == 0) {
			*found = true;
			return table->block[i].comment;
		}
	return 0;
}

static void compare_blocks(struct diff *diff, const char *pou, const struct var_table *a,
			   const struct var_table *b, uint16_t flags)
{
	struct compare_difference what = {
		.pou = pou, .kind = vars_head(flags), .subject = kept_text(flags),
	};
	bool in_a = true, in_b = true;

	for (int n = 0; in_a || in_b; n++) {
		const uint32_t above = nth_block(a, flags, n, &in_a);

		compare_ids(diff, what, "comment", above, nth_block(b, flags, n, &in_b));
	}
}

static bool has_block(const struct var_table *table, int count, uint16_t flags)
{
	for (int i = 0; i < count; i++)
		if (table->block[i].flags == flags)
			return true;
	return false;
}

/* Each kind of block once. */
static void compare_above(struct diff *diff, const char *pou, const struct var_table *a,
			  const struct var_table *b)
{
	for (int i = 0; i < a->block_count; i++)
		if (!has_block(a, i, a->block[i].flags))
			compare_blocks(diff, pou, a, b, a->block[i].flags);
	for (int i = 0; i < b->block_count; i++)
		if (!has_block(b, i, b->block[i].flags) &&
		    !has_block(a, a->block_count, b->block[i].flags))
			compare_blocks(diff, pou, a, b, b->block[i].flags);
}

static const struct pou *pou_named(const struct project *project,
				   const char *name)
{
	int i = project_find_pou(project, name, strlen(name));

	return i < 0 ? NULL : &project->pou[i];
}

struct pairing {
	struct diff *diff;
	const struct pou *a, *b;
	int *to_b, *to_a;     /* partner of each rung, -1: none               */
	int *gap_a, *gap_b;   /* last partner in order before it, by b; -1 */
	uint32_t *id_a, *id_b;
	bool *moved;          /* of rungs of a                                */
};

/* ---- matching rungs ---- */

static int *new_numbers(struct diff *diff, int count, int value)
{
	int *numbers = diff_alloc(diff, count, sizeof(*numbers));

	for (int i = 0; numbers && i < count; i++)
		numbers[i] = value;
	return numbers;
}

static const struct cell nothing;

static bool is_nothing(const struct cell *cell)
{
	return memcmp(cell, &nothing, sizeof(nothing)) == 0;
}

/* ---- a rung as comparable bytes ---- */

static void put_number(const struct sink *sink, uint32_t number)
{
	sink_write(sink, (const char *)&number, sizeof(number));
}

static void put_text(const struct sink *sink, const struct project *project,
		     uint32_t id)
{
	size_t len = names_len(&project->names, id);

	put_number(sink, (uint32_t)len);
	sink_write(sink, names_text(&project->names, id), len);
}

static uint32_t rung_id(struct diff *diff, const struct project *project,
			const struct rung *rung)
{
	struct sink sink = sink_to_memory(&diff->bytes);

	diff->bytes.len = 0;
	put_text(&sink, project, rung->label);
	put_text(&sink, project, rung->title);
	put_text(&sink, project, rung->comment);
	put_number(&sink, rung->off);
	for (int row = 0; row < rung->rows; row++)
		for (int col = 0; col < rung->cols; col++) {
			const struct cell *cell = rung_at(rung, row, col);

			if (is_nothing(cell))
				continue;
			put_number(&sink, (uint32_t)(row << 16 | col));
			put_number(&sink, (uint32_t)(cell->word << 1 |
						     (cell->link != 0)));
			put_text(&sink, project, cell->operand);
			put_text(&sink, project, cell->args);
			put_text(&sink, project, cell->comment);
		}
	return diff_id(diff, diff->bytes.text, diff->bytes.len);
}

static uint32_t *ids_of(struct diff *diff, const struct project *project,
			const struct pou *pou)
{
	uint32_t *id = diff_alloc(diff, pou->rung_count, sizeof(*id));

	for (int i = 0; id && i < pou->rung_count; i++)
		id[i] = rung_id(diff, project, pou->rung[i]);
	return id;
}

static bool pairing_start(struct pairing *pairs)
{
	struct diff *diff = pairs->diff;
	int a_count = pairs->a->rung_count, b_count = pairs->b->rung_count;

	pairs->to_b = new_numbers(diff, a_count, -1);
	pairs->to_a = new_numbers(diff, b_count, -1);
	pairs->gap_a = new_numbers(diff, a_count, -1);
	pairs->gap_b = new_numbers(diff, b_count, -1);
	pairs->moved = diff_alloc(diff, a_count, sizeof(*pairs->moved));
	pairs->id_a = ids_of(diff, diff->a, pairs->a);
	pairs->id_b = ids_of(diff, diff->b, pairs->b);
	return !diff->failed;
}

static bool pair_in_order(struct pairing *pairs)
{
	int gap = -1;

	if (!diff_match(&pairs->diff->arena, pairs->id_a, pairs->a->rung_count,
			pairs->id_b, pairs->b->rung_count, pairs->to_b))
		return false;
	for (int i = 0; i < pairs->a->rung_count; i++) {
		if (pairs->to_b[i] >= 0) {
			gap = pairs->to_b[i];
			pairs->to_a[gap] = i;
		}
		pairs->gap_a[i] = gap;
	}
	gap = -1;
	for (int j = 0; j < pairs->b->rung_count; j++) {
		if (pairs->to_a[j] >= 0)
			gap = j;
		pairs->gap_b[j] = gap;
	}
	return true;
}

/* Pairs the remaining rungs that have the same key; key 0 pairs with none. */
static bool pair_by_key(struct pairing *pairs, const uint32_t *key_a,
			const uint32_t *key_b)
{
	int *first = new_numbers(pairs->diff, pairs->diff->names.count + 1, -1);
	int *next = new_numbers(pairs->diff, pairs->b->rung_count, -1);

	if (!first || !next)
		return false;
	for (int j = pairs->b->rung_count - 1; j >= 0; j--)
		if (pairs->to_a[j] < 0 && key_b[j]) {
			next[j] = first[key_b[j]];
			first[key_b[j]] = j;
		}
	for (int i = 0; i < pairs->a->rung_count; i++) {
		int j = pairs->to_b[i] < 0 && key_a[i] ? first[key_a[i]] : -1;

		if (j < 0)
			continue;
		first[key_a[i]] = next[j];
		pairs->to_b[i] = j;
		pairs->to_a[j] = i;
		pairs->moved[i] = pairs->gap_a[i] != pairs->gap_b[j];
	}
	return true;
}

static uint32_t *labels_of(struct diff *diff, const struct project *project,
			   const struct pou *pou)
{
	uint32_t *key = diff_alloc(diff, pou->rung_count, sizeof(*key));

	for (int i = 0; key && i < pou->rung_count; i++)
		key[i] = diff_name(diff, project_text(project, pou->rung[i]->label));
	return key;
}

static const struct cell *cell_or_nothing(const struct rung *rung, int row,
					  int col)
{
	return row < rung->rows && col < rung->cols ? rung_at(rung, row, col) :
						      &nothing;
}

/* Two thirds of a cell's weight is its operand, one third its word. */
static bool alike(const struct diff *diff, const struct rung *a,
		  const struct rung *b)
{
	int rows = a->rows > b->rows ? a->rows : b->rows;
	int cols = a->cols > b->cols ? a->cols : b->cols;
	int same = 0, all = 0;

	for (int row = 0; row < rows; row++)
		for (int col = 0; col < cols; col++) {
			const struct cell *x = cell_or_nothing(a, row, col);
			const struct cell *y = cell_or_nothing(b, row, col);

			if (x->word <= ELEM_WIRE && y->word <= ELEM_WIRE)
				continue;
			all += 3;
			same += x->word == y->word;
			same += 2 * !strcmp(project_text(diff->a, x->operand),
					    project_text(diff->b, y->operand));
		}
	return all > 0 && 2 * same >= all;
}

static void pair_by_likeness(struct pairing *pairs)
{
	for (int i = 0; i < pairs->a->rung_count; i++) {
		int begin = pairs->gap_a[i] + 1, looked = 0;

		if (pairs->to_b[i] >= 0)
			continue;
		for (int j = begin; j < pairs->b->rung_count &&
		     pairs->gap_b[j] == begin - 1 &&
		     looked < DIFF_CANDIDATES; j++) {
			if (pairs->to_a[j] >= 0)
				continue;
			looked++;
			if (!alike(pairs->diff, pairs->a->rung[i],
				   pairs->b->rung[j]))
				continue;
			pairs->to_b[i] = j;
			pairs->to_a[j] = i;
			break;
		}
	}
}

/* In a gap, a rung that comes before the partner of a rung above it was moved. */
static void find_crossed(struct pairing *pairs)
{
	int last = -1;

	for (int i = 0; i < pairs->a->rung_count; i++) {
		int j = pairs->to_b[i];

		if (j < 0 || pairs->moved[i])
			continue;
		if (j < last)
			pairs->moved[i] = true;
		else
			last = j;
	}
}

/* ---- output ---- */

static struct compare_difference of_rung(const struct project *project,
				 const struct pou *pou, int index)
{
	return (struct compare_difference){
		.pou = project_text(project, pou->name), .rung = index + 1,
		.label = project_text(project, pou->rung[index]->label),
	};
}

static void give(struct diff *diff, int rung_a, int rung_b, bool moved, bool changed)
{
	struct compare_pair pair = diff->pair;

	pair.rung_a = rung_a;
	pair.rung_b = rung_b;
	pair.moved = moved;
	pair.changed = changed;
	diff->take(diff->context, pair);
}

static int tell_added(const struct pairing *pairs, int from, int end)
{
	for (int j = from; j < end; j++)
		if (pairs->to_a[j] < 0 && pairs->diff->take) {
			give(pairs->diff, -1, j, false, true);
		} else if (pairs->to_a[j] < 0) {
			struct compare_difference what = of_rung(pairs->diff->b,
								 pairs->b, j);
			what.change = "added";
			what.at_b = j + 1;
			diff_say(pairs->diff, &what);
		}
	return end > from ? end : from;
}

/* ---- cells ---- */

static void write_cell(const struct project *project, const struct cell *cell,
		       char *out, size_t size)
{
	out[0] = '\0';
	if (cell->word != ELEM_EMPTY)
		text_write_cell(project, cell, out, size);
}

/* One parameter; @value NULL: it is not there. */
static void value_text(const struct arg *arg, char *out, size_t size)
{
	out[0] = '\0';
	if (arg)
		snprintf(out, size, "%s%.*s",
			 arg->output ? "=> " : arg->inverse ? "/" : "",
			 (int)arg->value_len, arg->value);
}

static void compare_arg(struct diff *diff, struct compare_difference what,
			const struct arg *a, const struct arg *b)
{
	const struct arg *pin = a ? a : b;

	snprintf(diff->pin, sizeof(diff->pin), "%.*s", (int)pin->pin_len,
		 pin->pin);
	value_text(a, diff->from, sizeof(diff->from));
	value_text(b, diff->to, sizeof(diff->to));
	diff_texts(diff, what, diff->pin, diff->from, diff->to);
}

static void compare_args(struct diff *diff, struct compare_difference what,
			 const struct cell *a, const struct cell *b)
{
	const char *in_a = project_text(diff->a, a->args);
	const char *in_b = project_text(diff->b, b->args);
	const char *at = in_a;
	struct arg arg, other;
	int before = diff->count;

	snprintf(diff->subject, sizeof(diff->subject), "%s %s",
		 words_row(&diff->a->words, a->word)->word,
		 project_text(diff->a, a->operand));
	size_t end = strlen(diff->subject);
	if (end > 0 && diff->subject[end - 1] == ' ')
		diff->subject[end - 1] = '\0';
	what.subject = diff->subject;
	while (args_next(&at, &arg)) {
		bool found = args_find(in_b, arg.pin, arg.pin_len, &other);
		compare_arg(diff, what, &arg, found ? &other : NULL);
	}
	for (at = in_b; args_next(&at, &arg);)
		if (!args_find(in_a, arg.pin, arg.pin_len, &other))
			compare_arg(diff, what, NULL, &arg);
	if (diff->count == before && strcmp(in_a, in_b) != 0)
		diff_texts(diff, what, "parameters", in_a, in_b);
}

static void compare_cells(struct diff *diff, struct compare_difference what,
			  const struct cell *a, const struct cell *b)
{
	bool same = a->word == b->word &&
		    strcmp(project_text(diff->a, a->operand),
			   project_text(diff->b, b->operand)) == 0;

	if (!same) {
		write_cell(diff->a, a, diff->from, sizeof(diff->from));
		write_cell(diff->b, b, diff->to, sizeof(diff->to));
		diff_texts(diff, what, NULL, diff->from, diff->to);
	} else {
		compare_args(diff, what, a, b);
	}
	compare_ids(diff, what, "comment", a->comment, b->comment);
	if (!a->link != !b->link) {
		what.property = "link";
		what.change = b->link ? "added" : "removed";
		diff_say(diff, &what);
	}
}

static void say_changes(struct diff *diff, struct compare_difference what,
			  const struct rung *a, const struct rung *b)
{
	int rows = a->rows > b->rows ? a->rows : b->rows;
	int cols = a->cols > b->cols ? a->cols : b->cols;

	compare_ids(diff, what, "label", a->label, b->label);
	compare_ids(diff, what, "title", a->title, b->title);
	compare_ids(diff, what, "comment", a->comment, b->comment);
	if (!a->off != !b->off) {
		what.change = b->off ? "switched off" : "switched on";
		diff_say(diff, &what);
		what.change = NULL;
	}
	for (what.row = 1; what.row <= rows; what.row++)
		for (what.col = 1; what.col <= cols; what.col++)
			compare_cells(diff, what,
				cell_or_nothing(a, what.row - 1, what.col - 1),
				cell_or_nothing(b, what.row - 1, what.col - 1));
}

static void tell(const struct pairing *pairs, int i)
{
	struct diff *diff = pairs->diff;
	struct compare_difference what = of_rung(diff->a, pairs->a, i);
	int j = pairs->to_b[i];
	what.at_a = i + 1;
	what.at_b = j + 1;
	bool changed = j < 0 || pairs->id_a[i] != pairs->id_b[j];
	char moved[40];

	if (diff->take) {
		give(diff, i, j, pairs->moved[i], changed);
		return;
	}
	if (j >= 0 && pairs->moved[i]) {
		snprintf(moved, sizeof(moved), "moved to rung %d", j + 1);
		what.change = moved;
		diff_say(diff, &what);
		what.change = NULL;
	} else if (j < 0) {
		what.change = "removed";
		diff_say(diff, &what);
	}
	if (j >= 0 && changed)
		say_changes(diff, what, pairs->a->rung[i], pairs->b->rung[j]);
}

static void diff_rungs(struct diff *diff, const struct pou *a, const struct pou *b)
{
	struct pairing pairs = { .diff = diff, .a = a, .b = b };
	int told = 0;

	if (!pairing_start(&pairs))
		return;
	uint32_t *label_a = labels_of(diff, diff->a, a);
	uint32_t *label_b = labels_of(diff, diff->b, b);
	if (diff->failed || !pair_in_order(&pairs) ||
	    !pair_by_key(&pairs, pairs.id_a, pairs.id_b) ||
	    !pair_by_key(&pairs, label_a, label_b)) {
		diff->failed = true;
		return;
	}
	pair_by_likeness(&pairs);
	find_crossed(&pairs);
	for (int i = 0; i < a->rung_count; i++) {
		if (pairs.to_b[i] >= 0 && !pairs.moved[i])
			told = tell_added(&pairs, told, pairs.to_b[i]);
		tell(&pairs, i);
	}
	tell_added(&pairs, told, b->rung_count);
}

struct lines {
	char *text;        /* cut into lines, NUL-ended                       */
	char **line;
	int *indent;       /* blanks before it                                */
	uint32_t *id;
	int count;
};

/* Operands are aligned with blanks; differences in alignment are ignored. */
static char *one_blank(char *line)
{
	char *begin = line + strspn(line, " "), *to = begin;

	for (const char *from = begin; *from; from++)
		if (*from != ' ' || from[1] != ' ')
			*to++ = *from;
	*to = '\0';
	return begin;
}

static bool cut_lines(struct diff *diff, struct lines *lines)
{
	char *at = strchr(lines->text, '\n');

	while (at) {
		*at++ = '\0';
		char *end = strchr(at, '\n');
		char **line;

		/* The last line is END_PROGRAM. */
		if (!end || end[1] == '\0')
			break;
		line = arena_push(&diff->arena, &lines->line, &lines->count,
				  sizeof(*line));
		if (!line)
			return false;
		*line = at;
		at = end;
	}
	if (at)
		*at = '\0';
	return true;
}

static const struct config none;

/* The body of a POU as text, between a first and a last line. */
static bool write_body(const struct project *project, const struct pou *pou,
		       const struct sink *sink)
{
	const struct var_table no_vars = { 0 };

	if (pou->language == LANGUAGE_ST || pou->fbd) {
		sink_text(sink, "PROGRAM\n");
		if (pou->fbd)
			for (int i = 0; i < pou->fbd->count; i++)
				text_write_network(project, pou, i, sink);
		else
			text_write_st(project, pou->st, sink);
		sink_text(sink, "END_PROGRAM\n");
		return true;
	}
	if (pou->language != LANGUAGE_SFC)
		return pou_print_il(project, pou, &no_vars, NULL, 0, &pou->il, sink);
	sink_text(sink, "PROGRAM\n");
	text_write_sfc(project, pou, sink);
	sink_text(sink, "END_PROGRAM\n");
	return true;
}

static bool make_lines(struct diff *diff, const struct project *project,
		       const struct pou *pou, struct lines *lines)
{
	const struct sink sink = sink_to_memory(&diff->bytes);

	if (!pou)
		return true;
	diff->bytes.len = 0;
	if (!write_body(project, pou, &sink) || diff->bytes.failed)
		return false;
	lines->text = arena_copy(&diff->arena, diff->bytes.text,
				 diff->bytes.len);
	if (!lines->text || !cut_lines(diff, lines))
		return false;
	lines->id = diff_alloc(diff, lines->count, sizeof(*lines->id));
	lines->indent = diff_alloc(diff, lines->count, sizeof(*lines->indent));
	if (!lines->id || !lines->indent)
		return false;
	for (int i = 0; i < lines->count; i++) {
		char *line = one_blank(lines->line[i]);

		lines->indent[i] = (int)(line - lines->line[i]);
		lines->line[i] = line;
		lines->id[i] = diff_id(diff, line, strlen(line));
	}
	return !diff->failed;
}

/* The lines from (i, j) up to (i_end, j_end) have no match: pairs of them are changes,
 * the rest was added or removed. */
static void tell_gap(struct diff *diff, struct compare_difference what,
		     const struct lines *a, int i, int i_end,
		     const struct lines *b, int j, int j_end)
{
	for (; i < i_end && j < j_end; i++, j++) {
		what.line = what.at_a = i + 1;
		what.at_b = j + 1;
		diff_texts(diff, what, NULL, a->line[i], b->line[j]);
	}
	what.at_b = 0;
	for (; i < i_end; i++) {
		what.line = what.at_a = i + 1;
		what.change = "removed";
		what.subject = a->line[i];
		diff_say(diff, &what);
	}
	what.at_a = 0;
	for (; j < j_end; j++) {
		what.line = what.at_b = j + 1;
		what.change = "added";
		what.subject = b->line[j];
		diff_say(diff, &what);
	}
}

/* Line @i of @a, line @j of @b; -1: there is none. */
static void give_line(struct diff *diff, const struct lines *a, int i,
		      const struct lines *b, int j)
{
	const struct lines *in = i < 0 ? b : a;
	const int at = i < 0 ? j : i;

	diff->take_line(diff->context, (struct compare_line){ i + 1, j + 1, in->indent[at],
							   in->line[at] });
}

static void give_gap(struct diff *diff, const struct lines *a, int i, int i_end,
		     const struct lines *b, int j, int j_end)
{
	for (; i < i_end; i++)
		give_line(diff, a, i, b, -1);
	for (; j < j_end; j++)
		give_line(diff, a, -1, b, j);
}

/* Lists and charts; with take_line, one of them may be NULL. */
static void diff_il(struct diff *diff, const struct pou *a, const struct pou *b)
{
	struct compare_difference what = { .pou = a ? project_text(diff->a, a->name) : NULL };
	struct lines x = { 0 }, y = { 0 };
	int i = 0, j = 0, *match = NULL;

	if (make_lines(diff, diff->a, a, &x) &&
	    make_lines(diff, diff->b, b, &y))
		match = diff_alloc(diff, x.count, sizeof(*match));
	if (!match || !diff_match(&diff->arena, x.id, x.count, y.id, y.count,
				  match)) {
		diff->failed = true;
		return;
	}
	for (int at = 0; at <= x.count; at++) {
		const int to = at < x.count ? match[at] : y.count;

		if (to < 0)
			continue;
		if (diff->take_line)
			give_gap(diff, &x, i, at, &y, j, to);
		else
			tell_gap(diff, what, &x, i, at, &y, j, to);
		if (diff->take_line && at < x.count)
			give_line(diff, &x, at, &y, to);
		i = at + 1;
		j = to + 1;
	}
}

static void compare_pou(struct diff *diff, const struct pou *a,
			const struct pou *b)
{
	const char *name = project_text(diff->a, a->name);
	struct compare_difference what = { .pou = name };

	diff_texts(diff, what, "name", name, project_text(diff->b, b->name));
	diff_texts(diff, what, "kind", pou_word(a->kind), pou_word(b->kind));
	compare_ids(diff, what, "comment", a->comment, b->comment);
	compare_ids(diff, what, "closing comment", a->tail, b->tail);
	compare_above(diff, name, &a->vars, &b->vars);
	compare_vars(diff, name, &a->vars, &b->vars);
	if (a->sfc && b->sfc)
		diff_texts(diff, what, "evolution", sfc_evolution_words(a->sfc->evolution),
			   sfc_evolution_words(b->sfc->evolution));
	if (a->language != b->language)
		diff_texts(diff, what, "language", pou_language_word(a->language),
			   pou_language_word(b->language));
	else if (a->language == LANGUAGE_LD)
		diff_rungs(diff, a, b);
	else
		diff_il(diff, a, b);
}

static const char *kind_text(const struct pou *pou)
{
	return pou->kind == POU_PROGRAM ? "program" :
	       pou->kind == POU_FUNCTION ? "function" :
	       pou->kind == POU_BLOCK ? "function block" :
	       pou->kind == POU_ACTION ? "action" : "subroutine";
}

static void compare_pous(struct diff *diff)
{
	struct compare_difference what = { 0 };

	for (int i = 0; i < diff->a->pou_count; i++) {
		const struct pou *a = &diff->a->pou[i];
		const struct pou *b;

		what.subject = project_text(diff->a, a->name);
		what.kind = kind_text(a);
		what.change = "removed";
		b = pou_named(diff->b, what.subject);
		if (b)
			compare_pou(diff, a, b);
		else
			diff_say(diff, &what);
	}
	for (int j = 0; j < diff->b->pou_count; j++) {
		what.subject = project_text(diff->b, diff->b->pou[j].name);
		what.kind = kind_text(&diff->b->pou[j]);
		what.change = "added";
		if (!pou_named(diff->a, what.subject))
			diff_say(diff, &what);
	}
}

/* ---- structures ---- */

static const struct structure *structure_named(const struct project *project,
					       const char *name)
{
	for (int i = 0; i < project->structure_count; i++)
		if (name_is(project_text(project, project->structure[i].name), name,
			    strlen(name)))
			return &project->structure[i];
	return NULL;
}

static void compare_structures(struct diff *diff)
{
	struct compare_difference what = { .kind = "type" };

	for (int i = 0; i < diff->a->structure_count; i++) {
		const struct structure *a = &diff->a->structure[i], *b;

		if (!a->name) /* a part of its declaration */
			continue;
		what.subject = project_text(diff->a, a->name);
		what.change = "removed";
		b = structure_named(diff->b, what.subject);
		if (!b) {
			diff_say(diff, &what);
			continue;
		}
		compare_vars(diff, what.subject, &a->vars, &b->vars);
		what.change = NULL;
		compare_ids(diff, what, "closing comment", a->comment, b->comment);
	}
	for (int j = 0; j < diff->b->structure_count; j++) {
		what.subject = project_text(diff->b, diff->b->structure[j].name);
		what.change = "added";
		if (diff->b->structure[j].name && !structure_named(diff->a, what.subject))
			diff_say(diff, &what);
	}
}

/* ---- sections of other programs ---- */

/* The part of @kind after part @*at; NULL: there is none. */
static const struct part *next_part(const struct project *project, enum part_kind kind, int *at)
{
	while (*at < project->part_count) {
		const struct part *part = &project->part[(*at)++];

		if (part->kind == kind && !part->included)
			return part;
	}
	return NULL;
}

static const char *part_text(const struct project *project, const struct part *part)
{
	return part ? project_text(project, part->text) : NULL;
}

/* Files and sections in their order, and the comments above parts. What TYPE and CONFIGURATION hold
 * is compared elsewhere. */
static void compare_parts(struct diff *diff, enum part_kind kind,
			  const char *word)
{
	const bool named = kind == PART_INCLUDE || kind == PART_USES;
	struct compare_difference what = { .kind = word };
	int at_a = 0, at_b = 0;

	for (;;) {
		const struct part *x = next_part(diff->a, kind, &at_a);
		const struct part *y = next_part(diff->b, kind, &at_b);
		const char *a = part_text(diff->a, x), *b = part_text(diff->b, y);

		if (!a && !b)
			return;
		what.subject = !named ? NULL : b ? b : a;
		what.change = NULL;
		compare_ids(diff, what, kind == PART_CONFIG ? "opening comment" : "comment",
			    x ? x->comment : 0, y ? y->comment : 0);
		if (kind == PART_TYPES || kind == PART_CONFIG || (a && b && strcmp(a, b) == 0))
			continue;
		what.change = !a ? "added" : !b ? "removed" : "changed";
		diff_say(diff, &what);
	}
}

static void compare_texts(struct diff *diff)
{
	size_t a_len, b_len;
	char *a = text_write(diff->a, &a_len);
	char *b = text_write(diff->b, &b_len);

	if (!a || !b)
		diff->failed = true;
	else if (a_len != b_len || memcmp(a, b, a_len) != 0)
		diff_say(diff, &(struct compare_difference){
			.kind = "order, layout or comments",
			.change = "changed",
		});
	free(a);
	free(b);
}

static const struct config *config_of(const struct project *project)
{
	return project->config ? project->config : &none;
}

static const char *subject_of(const struct project *project,
			      const struct config_entry *entry)
{
	return entry->kind == CONFIG_AREA ? iec_area_row(entry->area)->letters :
					   project_text(project, entry->name);
}

/* The matching line of @project; NULL: there is none. */
static const struct config_entry *same_line(const struct project *project,
					   const struct config_entry *entry,
					   const char *subject)
{
	const struct config *config = config_of(project);

	for (int i = 0; i < config->count; i++) {
		const struct config_entry *other = &config->entry[i];
		const char *text = subject_of(project, other);

		if (other->kind == entry->kind && name_is(text, subject, strlen(subject)))
			return other;
	}
	return NULL;
}

static void compare_numbers(struct diff *diff, struct compare_difference what,
			    const char *property, uint32_t a, uint32_t b)
{
	char from[16], to[16];

	snprintf(from, sizeof(from), "%u", (unsigned)a);
	snprintf(to, sizeof(to), "%u", (unsigned)b);
	diff_texts(diff, what, property, from, to);
}

static void compare_entry(struct diff *diff, struct compare_difference what,
			 const struct config_entry *a,
			 const struct config_entry *b)
{
	compare_ids(diff, what, "INTERVAL", a->interval, b->interval);
	compare_ids(diff, what, "SINGLE", a->single, b->single);
	compare_numbers(diff, what, "PRIORITY", a->priority, b->priority);
	compare_ids(diff, what, "WATCHDOG", a->watchdog, b->watchdog);
	compare_ids(diff, what, "task", a->task, b->task);
	compare_ids(diff, what, "program", a->pou, b->pou);
	compare_numbers(diff, what, "bytes", a->bytes, b->bytes);
	compare_ids(diff, what, "comment", a->comment, b->comment);
}

static const char *kind_of(const struct config_entry *entry)
{
	static const char *const kind[] = {
		[CONFIG_VARS] = "", [CONFIG_ACCESS] = "", [CONFIG_LOCATED] = "", [CONFIG_AREA] = "area",
		[CONFIG_TASK] = "task", [CONFIG_PROGRAM] = "instance", [CONFIG_RESOURCE] = "resource",
	};

	return kind[entry->kind];
}

static bool is_block(const struct config_entry *entry)
{
	return entry->kind == CONFIG_VARS || entry->kind == CONFIG_ACCESS ||
	       entry->kind == CONFIG_LOCATED;
}

/* Tasks, programs and areas of the configurations. */
static void diff_config(struct diff *diff)
{
	const struct config *a = config_of(diff->a), *b = config_of(diff->b);
	struct compare_difference what = { .kind = "configuration" };

	compare_ids(diff, what, "name", a->name, b->name);
	compare_ids(diff, what, "comment", a->comment, b->comment);
	compare_ids(diff, what, "resource", a->resource, b->resource);
	compare_ids(diff, what, "kind of the resource", a->on, b->on);
	compare_ids(diff, what, "comment of the resource", a->resource_comment,
		    b->resource_comment);
	compare_ids(diff, what, "comment in the resource", a->resource_inside,
		    b->resource_inside);
	compare_ids(diff, what, "comment behind the resource", a->resource_behind,
		    b->resource_behind);
	for (int i = 0; i < a->count; i++) {
		const struct config_entry *entry = &a->entry[i], *other;

		what.kind = kind_of(entry);
		what.subject = subject_of(diff->a, entry);
		if (is_block(entry))
			continue;
		other = same_line(diff->b, entry, what.subject);
		what.change = other ? NULL : "removed";
		if (other)
			compare_entry(diff, what, entry, other);
		else
			diff_say(diff, &what);
	}
	what.change = "added";
	for (int i = 0; i < b->count; i++) {
		what.kind = kind_of(&b->entry[i]);
		what.subject = subject_of(diff->b, &b->entry[i]);
		if (!is_block(&b->entry[i]) &&
		    !same_line(diff->a, &b->entry[i], what.subject))
			diff_say(diff, &what);
	}
}

/* ---- VAR_ACCESS ---- */

static const struct access *access_named(const struct project *project, const char *name)
{
	for (int i = 0; i < project->access_count; i++)
		if (name_is(project_text(project, project->access[i].var.name), name,
			    strlen(name)))
			return &project->access[i];
	return NULL;
}

/* The comment above a block; 0: there is none. */
static uint32_t access_above(const struct project *project, int index)
{
	return index < project->access_block_count ? project->access_block[index].comment : 0;
}

/* What operators and gateways may read and write, by its name. */
static void diff_access(struct diff *diff)
{
	struct compare_difference what = { .kind = "VAR_ACCESS" };

	for (int i = 0; i < diff->a->access_block_count || i < diff->b->access_block_count; i++)
		compare_ids(diff, what, "comment", access_above(diff->a, i),
			    access_above(diff->b, i));
	what.kind = "access";
	for (int i = 0; i < diff->a->access_count; i++) {
		const struct access *a = &diff->a->access[i], *b;

		what.subject = project_text(diff->a, a->var.name);
		b = access_named(diff->b, what.subject);
		what.change = b ? NULL : "removed";
		if (!b) {
			diff_say(diff, &what);
			continue;
		}
		diff_texts(diff, what, "path", project_text(diff->a, a->path),
			   project_text(diff->b, b->path));
		diff_texts(diff, what, "type", type_text(diff->a, &a->var, diff->from),
			   type_text(diff->b, &b->var, diff->to));
		diff_texts(diff, what, "direction", access_word(a->writes),
			   access_word(b->writes));
		compare_ids(diff, what, "comment", a->var.comment, b->var.comment);
	}
	what.change = "added";
	for (int i = 0; i < diff->b->access_count; i++) {
		what.subject = project_text(diff->b, diff->b->access[i].var.name);
		if (!access_named(diff->a, what.subject))
			diff_say(diff, &what);
	}
}

static void compare(struct diff *diff)
{
	struct compare_difference what = { .kind = "project" };
	const struct project *a = diff->a, *b = diff->b;

	compare_ids(diff, what, "title", a->title, b->title);
	for (int i = 0; i < PROPERTY_COUNT; i++)
		compare_ids(diff, what, property_row(i)->name, a->property[i], b->property[i]);
	compare_ids(diff, what, "opening comment", a->head, b->head);
	compare_ids(diff, what, "closing comment", a->tail, b->tail);
	compare_parts(diff, PART_INCLUDE, "INCLUDE");
	compare_parts(diff, PART_USES, "USES");
	diff->group = COMPARE_CONFIG;
	compare_parts(diff, PART_CONFIG, "configuration");
	diff_config(diff);
	diff_access(diff);
	compare_above(diff, NULL, &a->located, &b->located);
	compare_vars(diff, NULL, &a->located, &b->located);
	diff->group = COMPARE_TYPES;
	compare_parts(diff, PART_TYPES, "TYPE");
	compare_structures(diff);
	diff->group = COMPARE_GLOBALS;
	compare_above(diff, NULL, &a->globals, &b->globals);
	compare_vars(diff, NULL, &a->globals, &b->globals);
	diff->group = COMPARE_POU;
	compare_pous(diff);
	diff->group = COMPARE_PROJECT;
	compare_parts(diff, PART_VIEW, "VIEW section");
	if (diff->count == 0 && !diff->failed)
		compare_texts(diff);
}

/* Prepares a comparison. Owns: the caller, diff_close(). NULL: no memory. */
static struct diff *diff_open(const struct project *a, const struct project *b,
			      const struct sink *sink)
{
	struct diff *diff = calloc(1, sizeof(*diff));

	if (!diff)
		return NULL;
	diff->a = a;
	diff->b = b;
	diff->sink = sink;
	arena_init(&diff->arena);
	names_init(&diff->names, &diff->arena);
	sink_memory_init(&diff->bytes);
	return diff;
}

/* False: memory ran out, and the result is incomplete. */
static bool diff_close(struct diff *diff)
{
	bool good = !diff->failed && !diff->arena.failed;

	sink_memory_free(&diff->bytes);
	arena_free(&diff->arena);
	free(diff);
	return good;
}

int compare_projects(const struct project *a, const struct project *b, bool json,
	      const struct sink *sink)
{
	struct diff *diff = diff_open(a, b, sink);

	if (!diff)
		return -1;
	diff->json = json;
	sink_text(sink, json ? "[" : "");
	compare(diff);
	sink_text(sink, json ? (diff->count ? "\n]\n" : "]\n") : "");

	int count = diff->count;
	return diff_close(diff) ? count : -1;
}

int compare_each(const struct project *a, const struct project *b,
		 void (*take)(void *context, const struct compare_difference *what),
		 void *context)
{
	struct diff *diff = diff_open(a, b, NULL);

	if (!diff)
		return -1;
	diff->take_difference = take;
	diff->context = context;
	compare(diff);

	int count = diff->count;
	return diff_close(diff) ? count : -1;
}

int compare_besides(const struct project *a, const struct project *b, const char *pou,
		      const struct sink *sink)
{
	struct diff *diff = diff_open(a, b, sink);

	if (!diff)
		return -1;
	diff->besides = true;
	diff->pou = pou;
	compare(diff);

	int said = diff->said;
	return diff_close(diff) ? said : -1;
}

/* All rungs of a POU that the other project does not have. */
static void give_all(struct diff *diff, const struct pou *pou, bool added)
{
	struct compare_pair pair = diff->pair;
	bool list = pou->language != LANGUAGE_LD;

	pair.changed = true;
	pair.rung_a = pair.rung_b = -1;
	for (int i = 0; i < (list ? 1 : pou->rung_count); i++) {
		if (!list)
			*(added ? &pair.rung_b : &pair.rung_a) = i;
		diff->take(diff->context, pair);
	}
}

static void give_pou(struct diff *diff, int index)
{
	const struct pou *a = &diff->a->pou[index];
	const char *name = project_text(diff->a, a->name);
	int other = project_find_pou(diff->b, name, strlen(name));
	const struct pou *b = other < 0 ? NULL : &diff->b->pou[other];

	diff->pair = (struct compare_pair){ index, other, -1, -1, false, true };
	if (b && a->language == LANGUAGE_LD && b->language == LANGUAGE_LD) {
		diff_rungs(diff, a, b);
	} else if (b && a->language == b->language) {
		diff->count = 0;
		void (*take)(void *, struct compare_pair) = diff->take;
		diff->take = NULL;
		diff_il(diff, a, b);
		diff->take = take;
		diff->pair.changed = diff->count > 0;
		diff->take(diff->context, diff->pair);
	} else if (b) {
		diff->take(diff->context, diff->pair);
	} else {
		give_all(diff, a, false);
	}
}

static void say_nothing(void *context, const char *text, size_t len)
{
	(void)context;
	(void)text;
	(void)len;
}

bool compare_rungs(const struct project *a, const struct project *b,
		     void (*take)(void *context, struct compare_pair pair),
		     void *context)
{
	const struct sink silent = { .write = say_nothing };
	struct diff *diff = diff_open(a, b, &silent);

	if (!diff)
		return false;
	diff->take = take;
	diff->context = context;
	for (int i = 0; i < a->pou_count && !diff->failed; i++)
		give_pou(diff, i);
	for (int j = 0; j < b->pou_count && !diff->failed; j++) {
		const char *name = project_text(b, b->pou[j].name);

		diff->pair = (struct compare_pair){ -1, j, -1, -1, false, true };
		if (project_find_pou(a, name, strlen(name)) < 0)
			give_all(diff, &b->pou[j], true);
	}
	return diff_close(diff);
}

bool compare_lines(const struct project *a, int pou_a, const struct project *b,
		     int pou_b,
		     void (*take)(void *context, struct compare_line line), void *context)
{
	const struct sink silent = { .write = say_nothing };
	struct diff *diff = diff_open(a, b, &silent);

	if (!diff)
		return false;
	diff->take_line = take;
	diff->context = context;
	diff_il(diff, pou_a < 0 ? NULL : &a->pou[pou_a], pou_b < 0 ? NULL : &b->pou[pou_b]);
	return diff_close(diff);
}
