/* SPDX-License-Identifier: MIT
 *
 * ldmicro_rung - circuits of LDmicro as rungs.
 *
 * LDmicro does one element after the other; here all contacts of a rung are read before its coils
 * act. A rung in which that makes a difference becomes several: a bit keeps the power between
 * them. Otherwise one rung stays one rung.
 */
#include "engine/exchange/ldmicro/ldmicro_parts.h"

#include "engine/base/limits.h"

#include <string.h>

enum {
	COLS = LIMIT_COLS - 4,   /* without a contact, a coil and a bar            */
	ROWS = 200,
	LEAVES = 400             /* of one rung here                               */
};

struct grid {
	const char *cell[ROWS][LIMIT_COLS];
	const struct ldmicro_piece *boxed[ROWS][LIMIT_COLS];
	bool link[ROWS][LIMIT_COLS + 1]; /* bar to the left of a cell, to the row above */
	int rows;
};

/* Elements in series, flat. */
struct items { struct ldmicro_node **node; int count; };

/* A part of a rung that is to be written. */
struct part {
	struct ldmicro_node **node;
	int count;
	const char *in;          /* a bit with the power at its left; NULL: the rail */
	const char *out;         /* gets the power at its right; NULL: nothing does */
};

/* ---- size ---- */

static bool needs_coil(const struct ldmicro_piece *piece)
{
	return piece->kind == PIECE_WIRE || piece->kind == PIECE_TEST;
}

struct extent { int cols, rows; };

static struct extent extent_of(struct ldmicro_conversion *c, struct ldmicro_node *node, bool last);

static struct extent extent_of_series(struct ldmicro_conversion *c, struct ldmicro_node *first, bool last)
{
	struct extent all = { 0, 1 };

	for (; first; first = first->next) {
		const struct extent one = extent_of(c, first, last && !first->next);

		all.cols += one.cols;
		if (one.rows > all.rows)
			all.rows = one.rows;
		if (all.cols > COLS || all.rows > ROWS)
			break;
	}
	if (!all.cols)
		all.cols = last ? 2 : 1;
	return all;
}

static struct extent extent_of(struct ldmicro_conversion *c, struct ldmicro_node *node, bool last)
{
	struct extent all = { 0, 0 };
	const struct ldmicro_piece *piece;

	if (node->word == LDM_SERIES)
		return extent_of_series(c, node->first, last);
	if (node->word != LDM_PARALLEL) {
		piece = piece_of(c, node);
		all.rows = 1;
		all.cols = piece ? 1 + (piece->edge != NULL) + (last && needs_coil(piece)) : 1;
		return all;
	}
	for (struct ldmicro_node *branch = node->first; branch; branch = branch->next) {
		const struct extent one = extent_of(c, branch, last);

		all.rows += one.rows;
		if (one.cols > all.cols)
			all.cols = one.cols;
		if (all.cols > COLS || all.rows > ROWS)
			break;
	}
	if (!node->first)
		all = (struct extent){ last ? 2 : 1, 1 };
	return all;
}

/* ---- elements that may be in one rung ---- */

/* What coils have done that act later here than there. */
struct pending {
	struct name_list reads, writes;
	bool all;
	int leaves;
};

static bool meet(const struct name_list *a, const struct name_list *b)
{
	for (int i = 0; i < a->count; i++)
		for (int k = 0; k < b->count; k++)
			if (a->name[i] == b->name[k])
				return true;
	return false;
}

static void note(struct ldmicro_conversion *c, struct pending *pending, const struct ldmicro_piece *piece)
{
	for (int i = 0; i < piece->reads.count; i++)
		name_add(c, &pending->reads, piece->reads.name[i]);
	for (int i = 0; i < piece->writes.count; i++)
		name_add(c, &pending->writes, piece->writes.name[i]);
	pending->all = pending->all || piece->all;
}

/* @last: at the end of its branch. @end: only coils follow. */
static bool leaf_fits(struct ldmicro_conversion *c, struct ldmicro_node *node, bool last, bool end,
		      struct pending *pending)
{
	const struct ldmicro_piece *piece = piece_of(c, node);

	if (!piece || ++pending->leaves > LEAVES || piece->kind == PIECE_MASTER)
		return false;
	const bool acts = piece->kind == PIECE_COIL || piece->kind == PIECE_EDGE ||
			  piece->kind == PIECE_JUMP || (piece->kind == PIECE_LINES && last);

	if (acts && !last && !(piece->kind == PIECE_COIL && end))
		return false;
	if (piece->kind == PIECE_LINES && piece->all && !last)
		return false; /* a subroutine */
	if (acts) {
		/* An edge is found with the contacts; it touches no variable. */
		note(c, pending, piece);
		return true;
	}
	if (pending->all && piece->kind != PIECE_WIRE)
		return false;
	return !meet(&pending->writes, &piece->reads) && !meet(&pending->writes, &piece->writes) &&
	       !meet(&pending->reads, &piece->writes);
}

static bool series_fits(struct ldmicro_conversion *c, struct ldmicro_node *first, bool last, bool end,
			struct pending *pending);

static bool node_fits(struct ldmicro_conversion *c, struct ldmicro_node *node, bool last, bool end,
		      struct pending *pending)
{
	if (node->word == LDM_SERIES)
		return series_fits(c, node->first, last, end, pending);
	if (node->word != LDM_PARALLEL)
		return leaf_fits(c, node, last, end, pending);
	for (struct ldmicro_node *branch = node->first; branch; branch = branch->next)
		if (!node_fits(c, branch, last, false, pending))
			return false;
	return true;
}

static bool series_fits(struct ldmicro_conversion *c, struct ldmicro_node *first, bool last, bool end,
			struct pending *pending)
{
	for (; first; first = first->next)
		if (!node_fits(c, first, last && !first->next, end && !first->next, pending))
			return false;
	return true;
}

static bool part_fits(struct ldmicro_conversion *c, const struct part *part)
{
	struct pending pending = { .all = false };
	int cols = 0;

	for (int i = 0; i < part->count; i++) {
		const bool last = i == part->count - 1;
		const struct extent one = extent_of(c, part->node[i], last && !part->out);

		cols += one.cols;
		if (cols > COLS || one.rows > ROWS - 2 ||
		    !node_fits(c, part->node[i], last && !part->out, last, &pending))
			return false;
	}
	return true;
}

/* ---- drawing ---- */

static void put_cell(struct grid *grid, int row, int col, const char *text)
{
	grid->cell[row][col] = text;
	if (row >= grid->rows)
		grid->rows = row + 1;
}

static void link_rows(struct grid *grid, int from, int to, int bar)
{
	for (int row = from + 1; row <= to && bar > 0; row++)
		grid->link[row][bar] = true;
}

static const char *nowhere(struct ldmicro_conversion *c)
{
	if (!c->nowhere)
		c->nowhere = bit_new(c, "Nowhere");
	return c->nowhere;
}

static void draw(struct ldmicro_conversion *c, struct ldmicro_node *node, int row, int col, bool last);

static int draw_series(struct ldmicro_conversion *c, struct ldmicro_node *first, int row, int col, bool last)
{
	if (!first) {
		put_cell(c->grid, row, col++, "---");
		if (last)
			put_cell(c->grid, row, col++, w_text(&c->w, "COIL %s", nowhere(c)));
	}
	for (; first; first = first->next) {
		const bool end = last && !first->next;

		draw(c, first, row, col, end);
		col += extent_of(c, first, end).cols;
	}
	return col;
}

/* A branch that is a bare wire beside others would be an error here; LDmicro lets power through. */
static bool is_bare(struct ldmicro_conversion *c, struct ldmicro_node *branch)
{
	const struct ldmicro_piece *piece;

	if (branch->word == LDM_PARALLEL)
		return false;
	if (branch->word == LDM_SERIES) {
		for (struct ldmicro_node *node = branch->first; node; node = node->next)
			if (!is_bare(c, node))
				return false;
		return true;
	}
	piece = piece_of(c, branch);
	return piece && piece->kind == PIECE_WIRE;
}

static void bridge(struct ldmicro_conversion *c, int row, int col)
{
	const char *wire = c->grid->cell[row][col];

	if (wire && !strncmp(wire, "---", 3))
		c->grid->cell[row][col] = w_text(&c->w, "[ TRUE ]%s", wire + 3);
}

static void draw_parallel(struct ldmicro_conversion *c, struct ldmicro_node *node, int row, int col, bool last)
{
	const struct extent all = extent_of(c, node, last);
	int at = row, lowest = row;

	if (!node->first)
		draw_series(c, NULL, row, col, last);
	for (struct ldmicro_node *branch = node->first; branch; branch = branch->next) {
		const struct extent one = extent_of(c, branch, last);

		draw(c, branch, at, col, last);
		for (int i = col + one.cols; i < col + all.cols && !last; i++)
			put_cell(c->grid, at, i, "---");
		if (!last && is_bare(c, branch))
			bridge(c, at, col);
		lowest = at;
		at += one.rows;
	}
	link_rows(c->grid, row, lowest, col);
	if (!last)
		link_rows(c->grid, row, lowest, col + all.cols);
}

static void draw(struct ldmicro_conversion *c, struct ldmicro_node *node, int row, int col, bool last)
{
	const struct ldmicro_piece *piece;

	if (node->word == LDM_SERIES) {
		draw_series(c, node->first, row, col, last);
		return;
	}
	if (node->word == LDM_PARALLEL) {
		draw_parallel(c, node, row, col, last);
		return;
	}
	piece = piece_of(c, node);
	if (!piece)
		return;
	if (piece->edge)
		put_cell(c->grid, row, col++, piece->edge);
	const bool short_form = last && piece->last;

	put_cell(c->grid, row, col, short_form ? piece->last : piece->cell);
	if (piece->lines && !short_form)
		c->grid->boxed[row][col] = piece;
	if (last && needs_coil(piece))
		put_cell(c->grid, row, col + 1, w_text(&c->w, "COIL %s", nowhere(c)));
}

/* ---- writing ---- */

static void put_head(struct ldmicro_conversion *c)
{
	for (int i = 0; i < c->pending_comment.count; i++)
		w_comment(&c->w, "", c->pending_comment.name[i]);
	c->pending_comment.count = 0;
	c->pending_comment.name = NULL;
	w_put(&c->w, "RUNG%s%s\n", c->pending_label ? " " : "", c->pending_label ? c->pending_label : "");
	c->pending_label = NULL;
	c->w.rung++;
}

static void put_row(struct ldmicro_conversion *c, int row)
{
	const struct grid *grid = c->grid;
	int last = 0;

	for (int col = 0; col < LIMIT_COLS; col++)
		if (grid->cell[row][col] || grid->link[row][col + 1])
			last = col;
	w_put(&c->w, "  |");
	for (int col = 0; col <= last; col++)
		w_put(&c->w, " %s %s", grid->cell[row][col] ? grid->cell[row][col] : "",
		      grid->link[row][col + 1] ? "^|" : "|");
	w_put(&c->w, "\n");
}

static void put_grid(struct ldmicro_conversion *c)
{
	for (int row = 0; row < c->grid->rows; row++)
		put_row(c, row);
	for (int row = 0; row < c->grid->rows; row++)
		for (int col = 0; col < LIMIT_COLS; col++) {
			const struct ldmicro_piece *piece = c->grid->boxed[row][col];

			if (piece)
				w_put(&c->w, "  %s:\n%s  END_EXECUTE\n", piece->cell, piece->lines);
		}
}

static void write_part(struct ldmicro_conversion *c, const struct part *part)
{
	int col = 0;

	memset(c->grid, 0, sizeof(*c->grid));
	if (part->in)
		put_cell(c->grid, 0, col++, w_text(&c->w, "NO %s", part->in));
	for (int i = 0; i < part->count; i++) {
		const bool last = i == part->count - 1 && !part->out;

		draw(c, part->node[i], 0, col, last);
		col += extent_of(c, part->node[i], last).cols;
	}
	if (!col)
		put_cell(c->grid, 0, col++, "---");
	if (part->out)
		put_cell(c->grid, 0, col, w_text(&c->w, "COIL %s", part->out));
	put_head(c);
	put_grid(c);
}

void write_filler(struct ldmicro_conversion *c)
{
	put_head(c);
	w_put(&c->w, "  | --- | COIL %s |\n", nowhere(c));
}

/* Without the relay, or when it was open, it closes; else it takes the power. */
static void write_master(struct ldmicro_conversion *c, const char *in)
{
	if (!in) {
		put_head(c);
		w_put(&c->w, "  | --- | COIL %s |\n", c->master);
		return;
	}
	put_head(c);
	w_put(&c->w, "  | NO %s | COIL %s |\n  | NC %s ^|\n", in, c->master, c->master);
}

/* ---- rungs that must be cut ---- */

static void emit(struct ldmicro_conversion *c, struct part part);

static const char *power_new(struct ldmicro_conversion *c)
{
	return bit_new(c, "Power");
}

/* The power at the left of a part that becomes several, as a bit that nothing changes. */
static const char *hold(struct ldmicro_conversion *c, const char *in)
{
	const char *power;

	if (!in || in != c->master)
		return in;
	power = power_new(c);
	write_part(c, &(struct part){ .in = in, .out = power });
	return power;
}

static struct ldmicro_node *power_node(struct ldmicro_conversion *c, const char *bit)
{
	struct ldmicro_node *node = arena_alloc(c->w.arena, sizeof(*node));

	if (node)
		*node = (struct ldmicro_node){ .word = LDM_POWER, .text = bit, .line = c->w.at.line };
	return node;
}

/* A bit that is TRUE if one of @bit is. */
static const char *any_of(struct ldmicro_conversion *c, const struct name_list *bit)
{
	const char *sum = NULL;

	for (int from = 0; from < bit->count; from += ROWS / 2) {
		struct ldmicro_node *circuit = arena_alloc(c->w.arena, sizeof(*circuit)), **last;
		const char *out = power_new(c);

		if (!circuit)
			return out;
		*circuit = (struct ldmicro_node){ .word = LDM_PARALLEL, .line = c->w.at.line };
		last = &circuit->first;
		if (sum && (*last = power_node(c, sum)))
			last = &(*last)->next;
		for (int i = from; i < bit->count && i < from + ROWS / 2; i++)
			if ((*last = power_node(c, bit->name[i])))
				last = &(*last)->next;
		write_part(c, &(struct part){ &circuit, 1, NULL, out });
		sum = out;
	}
	return sum;
}

static struct items flatten(struct ldmicro_conversion *c, struct ldmicro_node *first)
{
	struct items items = { NULL, 0 };
	struct ldmicro_node *up[LDMICRO_DEPTH] = { NULL };
	int depth = 0;

	while (first || depth) {
		struct ldmicro_node **slot;

		if (!first) {
			first = up[--depth]->next;
			continue;
		}
		if (first->word == LDM_SERIES && depth < LDMICRO_DEPTH) {
			up[depth++] = first;
			first = first->first;
			continue;
		}
		slot = arena_push(c->w.arena, &items.node, &items.count, sizeof(*slot));
		if (!slot)
			break;
		*slot = first;
		first = first->next;
	}
	return items;
}

/* Each branch in rungs of its own; returns the power behind them, NULL: nobody asks. */
static const char *emit_branches(struct ldmicro_conversion *c, struct ldmicro_node *parallel, const char *in,
				 bool asked)
{
	struct name_list power = { NULL, 0 };

	for (struct ldmicro_node *branch = parallel->first; branch; branch = branch->next) {
		const char *out = asked ? power_new(c) : NULL;
		struct items items;

		if (branch->word == LDM_SERIES)
			items = flatten(c, branch->first);
		else
			items = (struct items){ &branch, 1 };
		if (out)
			name_add(c, &power, out);
		emit(c, (struct part){ items.node, items.count, in, out });
	}
	return asked ? any_of(c, &power) : NULL;
}

/* The first element, which does not fit into one rung with a coil behind it. Returns the power behind it. */
static const char *emit_first(struct ldmicro_conversion *c, struct part *part)
{
	struct ldmicro_node *node = part->node[0];
	const bool asked = part->count > 1 || part->out;
	const char *in = hold(c, part->in);

	if (node->word == LDM_PARALLEL)
		return emit_branches(c, node, in, asked);
	const struct ldmicro_piece *piece = piece_of(c, node);

	c->w.at.line = node->line;
	if (piece && piece->kind == PIECE_MASTER)
		write_master(c, in);
	else if (piece)
		write_part(c, &(struct part){ part->node, 1, in, NULL });
	return in;
}

/* The longest beginning that fits into one rung, a bit for its power, and so on. */
static void emit(struct ldmicro_conversion *c, struct part part)
{
	while (!c->w.arena->failed) {
		struct part some = part;

		if (!part.count || part_fits(c, &part)) {
			if (part.count || part.out)
				write_part(c, &part);
			return;
		}
		some.out = ""; /* named when it is needed */
		for (some.count = 1; some.count < part.count && some.count < COLS && part_fits(c, &some);)
			some.count++;
		while (some.count > 0 && (some.count == part.count || !part_fits(c, &some)))
			some.count--;
		if (some.count) {
			some.out = power_new(c);
			write_part(c, &some);
			part.in = some.out;
			part.node += some.count;
			part.count -= some.count;
			continue;
		}
		part.in = emit_first(c, &part);
		part.node++;
		part.count--;
	}
}

/* \r and \n of a comment end its lines; \\ is one. */
static const char *comment_of(struct ldmicro_conversion *c, const char *text)
{
	char *copy = arena_copy(c->w.arena, text + strlen("COMMENT"), strlen(text) - strlen("COMMENT"));
	size_t out = 0;

	for (const char *at = copy; at && *at; at++) {
		const char next = *at == '\\' ? at[1] : '\0';

		copy[out++] = next == 'r' || next == 'n' ? '\n' : *at;
		at += next == 'r' || next == 'n' || next == '\\';
	}
	if (copy)
		copy[out] = '\0';
	return copy ? copy + strspn(copy, " ") : "";
}

void convert_ldmicro_rung(struct ldmicro_conversion *c, int index)
{
	const struct ldmicro_rung *rung = &c->program->rung[index];
	const int before = c->w.rung;
	struct items all = flatten(c, rung->first), items = { NULL, 0 };

	if (!c->grid)
		c->grid = arena_alloc(c->w.arena, sizeof(*c->grid));
	if (!c->grid)
		return;
	c->rung = index;
	c->w.at.line = rung->line;
	for (int i = 0; i < all.count; i++) {
		struct ldmicro_node *node = all.node[i], **slot;

		if (node->word == LDM_COMMENT) {
			piece_of(c, node);
			name_add(c, &c->pending_comment, comment_of(c, node->text));
			continue;
		}
		if (node->word == LDM_LABEL || node->word == LDM_SUBPROG || node->word == LDM_ENDSUB) {
			piece_of(c, node);
			continue;
		}
		slot = arena_push(c->w.arena, &items.node, &items.count, sizeof(*slot));
		if (slot)
			*slot = node;
	}
	if (c->label[index] && c->target[index]) {
		if (c->pending_label)
			write_filler(c);
		c->pending_label = c->label[index];
	}
	if (!items.count)
		return;
	emit(c, (struct part){ items.node, items.count, c->master, NULL });
	if (c->w.rung > before + 1) {
		c->w.at.line = rung->line;
		w_tell(&c->w, REPORT_CHANGED, "this rung became %d, so that its elements act in the same order",
		       c->w.rung - before);
	}
}
