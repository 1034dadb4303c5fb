/* SPDX-License-Identifier: MIT
 *
 * test_storm - thousands of random edits of rungs, by hand and by rule.
 *
 * Wild: any edit anywhere; each result can be read, is in normal form and has the reported
 * place. Tame: edits that close their wires; the checks must accept the rung, and its power
 * must match: a closed contact in series and an open one in parallel change nothing, a
 * deleted element becomes a wire or nothing.
 */
#include "engine/check/check.h"
#include "tests/editor/grid_words.h"
#include "tests/tap.h"

#define EDITS 10000

static uint64_t state = 88172645463325252u;

static int roll(int count)
{
	state ^= state << 13;
	state ^= state >> 7;
	state ^= state << 17;
	return (int)(state >> 33) % count;
}

static struct cell make(struct grid_bench *bench, const char *words)
{
	static int number;
	char text[80];
	int pick = roll((int)strlen(words));

	number++;
	switch (words[pick]) {
	case 'o':
		snprintf(text, sizeof(text), "COIL Q%d", number);
		break;
	case 's':
		snprintf(text, sizeof(text), "S Q%d", number);
		break;
	case 't':
		snprintf(text, sizeof(text), "TON T%d PT:=T#1s", number);
		break;
	case 'c':
		snprintf(text, sizeof(text), "CTU C%d PV:=3", number);
		break;
	case 'a':
		snprintf(text, sizeof(text), "[ Level := %d ]", number);
		break;
	default:
		snprintf(text, sizeof(text), "%s V%d", words[pick] == 'x' ? "NC" : "NO",
			 number);
		break;
	}
	return grid_read_cell(bench, text);
}

/* ---- wild ---- */

static struct rung *wild(struct grid_bench *bench, const struct rung *rung,
			 struct grid_at *at)
{
	static const char *const verbs[] = {
		"place", "place", "insert", "below", "drop", "set", "delete", "delete",
		"delete-area", "delete-row", "delete-column", "insert-row",
		"insert-column", "open", "gaps", "negate", "cycle", "pin",
		"wire", "wire", "wire", "move", "copy", "paste", "paste-below", "move-area",
		"round", "draw", "draw", "erase",
	};
	static const char *const ways[] = { "up", "down", "left", "right" };
	const char *verb = verbs[roll((int)(sizeof(verbs) / sizeof(*verbs)))];
	struct grid_area area = { at->row, at->col, at->row + roll(3), at->col + roll(4) };
	char rest[60] = "";

	if (!strcmp(verb, "wire"))
		snprintf(rest, sizeof(rest), "%s", ways[roll(4)]);
	else if (!strcmp(verb, "pin"))
		snprintf(rest, sizeof(rest), "%s", roll(2) ? "R" : "R NO A");
	else if (!strcmp(verb, "move"))
		snprintf(rest, sizeof(rest), "%d %d", roll(rung->rows + 2) + 1,
			 roll(at->columns) + 1);
	else if (!strcmp(verb, "draw") || !strcmp(verb, "erase"))
		snprintf(rest, sizeof(rest), "%d %d%s", roll(rung->rows + 2) + 1,
			 roll(at->columns + 1) + 1, roll(2) ? " along" : "");
	else if (!strcmp(verb, "move-area"))
		snprintf(rest, sizeof(rest), "%d %d %d %d", area.last_row + 1,
			 area.last_col + 1, roll(rung->rows + 2) + 1,
			 roll(at->columns) + 1);
	else if (!strcmp(verb, "copy") || !strcmp(verb, "delete-area"))
		snprintf(rest, sizeof(rest), "%d %d", area.last_row + 1,
			 area.last_col + 1);
	else if (!strcmp(verb, "place"))
		return grid_place(rung, at, make(bench, "nnxxostcan"), GRID_REPLACE);
	else if (!strcmp(verb, "insert"))
		return grid_place(rung, at, make(bench, "nxostca"), GRID_INSERT);
	else if (!strcmp(verb, "below"))
		return grid_parallel(rung, at, NULL, make(bench, "nnxota"));
	else if (!strcmp(verb, "round"))
		return grid_parallel(rung, at, &area, make(bench, "nxo"));
	else if (!strcmp(verb, "drop"))
		return grid_drop(rung, at, make(bench, "nxostca"));
	else if (!strcmp(verb, "set"))
		return grid_set(rung, at, make(bench, "nxot"));
	else if (!bench->part && !strncmp(verb, "paste", 5))
		verb = "delete";
	return grid_play(bench, rung, verb, at, rest);
}

static const char *judge(struct grid_bench *bench, const struct rung *rung,
			 const struct rung *before, const struct rung *kept,
			 const struct grid_at *at)
{
	if (!rung_equal(before, kept))
		return "the edit changed the given rung";
	if (!rung)
		return at->refusal == GRID_DONE ? "the edit was refused without a reason" : NULL;
	if (at->refusal != GRID_DONE)
		return "the edit gave a rung and a refusal";
	if (rung->rows > LIMIT_ROWS || rung->cols > LIMIT_COLS)
		return "the rung is larger than the limits";
	if (at->row < 0 || at->col < 0 || at->col >= LIMIT_COLS)
		return "the cursor is outside the rung";
	return grid_wrong(bench, rung);
}

static void storm(struct grid_bench *bench)
{
	struct rung *rung = grid_read(bench, "");
	const char *wrong = NULL;
	int done = 0, most = 0, i;

	for (i = 0; i < EDITS && !wrong; i++) {
		struct rung *kept = rung_copy(rung), *made;
		struct grid_at at = { .columns = grid_display_columns(rung, GRID_COLUMNS) };

		at.row = roll(rung->rows + 1);
		at.col = roll(at.columns);
		made = wild(bench, rung, &at);
		wrong = judge(bench, made, rung, kept, &at);
		if (wrong) {
			char text[GRID_TEXT];

			grid_write(bench, kept, text, sizeof(text));
			printf("# edit %d: %s at %d %d\n%s", i, wrong, at.row, at.col,
			       text);
			if (made)
				grid_write(bench, made, text, sizeof(text));
			printf("# became\n%s", text);
		}
		rung_free(kept);
		if (made) {
			rung_free(rung);
			rung = made;
			done++;
		}
		if (rung->rows * rung->cols > most)
			most = rung->rows * rung->cols;
		/* sometimes start again, or the rung only grows */
		if (roll(150) == 0 || rung->rows > 40 || rung->cols > 40) {
			rung_free(rung);
			rung = grid_read(bench, "| NO A | COIL Q0 |\n");
		}
	}
	printf("# %d edits, %d done, largest %d cells\n", i, done, most);
	CHECK(!wrong);
	CHECK(done > EDITS / 3);
	rung_free(rung);
}

/* ---- at the limits ---- */

/* A full rung: an edit without room is refused and changes nothing. */
static void crowd(struct grid_bench *bench)
{
	struct rung *full = rung_new(LIMIT_ROWS, LIMIT_COLS);
	const struct cell contact = make(bench, "n"), coil = make(bench, "o");
	const char *wrong = NULL;
	int refused = 0;

	for (int i = 0; i < LIMIT_ROWS * LIMIT_COLS; i++) {
		full->cell[i] = i % LIMIT_COLS == LIMIT_COLS - 1 ? coil : contact;
		if (i >= LIMIT_COLS && i % LIMIT_COLS < LIMIT_COLS - 1)
			full->cell[i].link = (uint8_t)roll(2);
	}
	for (int i = 0; i < 30 && !wrong; i++) {
		struct grid_at at = { .columns = grid_display_columns(full, GRID_COLUMNS),
				      .row = roll(LIMIT_ROWS + 1), .col = roll(LIMIT_COLS) };
		struct rung *made = wild(bench, full, &at);

		refused += !made;
		if (made && (made->rows > LIMIT_ROWS || made->cols > LIMIT_COLS))
			wrong = "the rung is larger than the limits";
		if (!made && at.refusal == GRID_DONE)
			wrong = "the edit was refused without a reason";
		rung_free(made);
	}
	CHECK(!wrong);
	CHECK(refused > 5);
	rung_free(full);
}

/* ---- tame ---- */

/* Contacts are closed by a bit of their number, one of them as forced. */
struct flow {
	uint32_t seed, forced; /* operand that is forced; 0: none             */
	bool closed;           /* its state                                   */
	uint32_t ignored;      /* an output that does not count               */
};

static bool is_closed(const struct flow *flow, const struct cell *cell)
{
	uint32_t mixed = cell->operand * 2654435761u ^ flow->seed * 40503u;

	if (cell->operand == flow->forced)
		return flow->closed;
	return (mixed ^ mixed >> 15) & 1;
}

/* A checksum of the outputs that have power. */
static uint64_t powered(const struct rung *rung, const struct flow *flow)
{
	struct network n;
	struct arena arena;
	uint64_t sum = 0;
	bool *live, again = true;

	arena_init(&arena);
	if (!network_make(rung, &arena, &n))
		return 0;
	live = arena_alloc(&arena, (size_t)n.net_count);
	live[NET_RAIL] = true;
	while (again) {
		again = false;
		for (int i = 0; i < n.element_count; i++) {
			const struct network_element *e = &n.element[i];
			const struct cell *cell = rung_at(rung, e->row, e->col);

			/* as a wire, in both directions */
			if (live[e->out] && !live[e->in] && flow->closed &&
			    cell->operand == flow->forced)
				live[e->in] = again = true;
			if (!live[e->in] || live[e->out] ||
			    !is_closed(flow, cell))
				continue;
			live[e->out] = again = true;
		}
	}
	for (int i = 0; i < n.element_count; i++)
		if (word_row((enum word)n.element[i].word)->place == PLACE_LAST &&
		    live[n.element[i].in] &&
		    rung_at(rung, n.element[i].row, n.element[i].col)->operand !=
			    flow->ignored)
			sum += (uint64_t)rung_at(rung, n.element[i].row,
						 n.element[i].col)->operand * 11400714819323198485u;
	arena_free(&arena);
	return sum;
}

/* Do both rungs give power to the same outputs, for any state of the contacts? */
static bool same_power(const struct rung *a, struct flow fa, const struct rung *b,
		       struct flow fb)
{
	for (uint32_t seed = 1; seed <= 24; seed++) {
		fa.seed = fb.seed = seed;
		if (powered(a, &fa) != powered(b, &fb))
			return false;
	}
	return true;
}

static bool is_clean(struct grid_bench *bench, const struct rung *rung)
{
	struct network network;
	struct arena arena, scratch;
	bool clean;

	arena_init(&arena);
	arena_init(&scratch);
	diag_init(&bench->diags);
	clean = network_make(rung, &arena, &network) &&
		check_rung(bench->project, &bench->project->pou[0], 1, rung, &network,
			   &scratch, &bench->diags);
	arena_free(&arena);
	arena_free(&scratch);
	return clean;
}

static const char *tame_place(const struct rung *before, const struct rung *made,
			      struct cell cell, bool below)
{
	struct flow with = { .forced = cell.operand, .closed = !below }, none = { 0 };

	return same_power(made, with, before, none) ? NULL : "the edit changed another circuit";
}

static const char *tame_delete(const struct rung *before, const struct rung *made,
			       uint32_t operand)
{
	struct flow closed = { .forced = operand, .closed = true };
	struct flow open = { .forced = operand }, none = { 0 };

	return same_power(before, closed, made, none) ||
	       same_power(before, open, made, none) ? NULL :
		"the moved contact left neither a wire nor an empty cell";
}

static bool is_contact(const struct rung *rung, const struct grid_place *place)
{
	return place->seen == GRID_SEEN_CELL &&
	       word_row((enum word)rung_at(rung, place->row, place->col)->word)->operand ==
		       OPND_BOOL_R;
}

/* A new output in any row and branch leaves the others unchanged. */
static struct rung *tame_output(struct grid_bench *bench, const struct rung *rung,
				struct grid_at *at, const char **wrong)
{
	const struct cell coil = make(bench, "os");
	struct flow with = { .ignored = coil.operand }, none = { 0 };
	struct rung *made = roll(2) ? grid_parallel(rung, at, NULL, coil) :
				      grid_place(rung, at, coil, GRID_INSERT);

	if (made && !same_power(made, with, rung, none))
		*wrong = "the new output changed another circuit";
	return made;
}

/* In a complete rung a moved contact leaves a wire or nothing, and the target stays
 * complete. */
static struct rung *tame_move(const struct rung *rung, struct grid_at *at)
{
	struct grid_at to = { .columns = at->columns, .row = roll(rung->rows + 1),
			      .col = roll(at->columns) };
	struct rung *source, *made;

	switch (grid_can_drop(rung, at->columns, to.row, to.col, ELEM_CONTACT_NO)) {
	case GRID_DROP_WIRE:
	case GRID_DROP_BEFORE:
	case GRID_DROP_BELOW:
		break;
	case GRID_DROP_NOT:
	case GRID_DROP_THERE:
	case GRID_DROP_OUTPUT:
		return NULL;
	}
	made = grid_move(rung, at, rung, &to, &source);
	*at = to;
	return made;
}

/* Does the wire carry power only to the left? An element would be the wrong way around. */
static bool leads_left(const struct rung *rung, const struct grid_place *place)
{
	struct rung *cut = rung_copy(rung);
	struct arena arena;
	struct network n;
	bool left = true;
	int in, out;

	arena_init(&arena);
	rung_cell(cut, place->row, place->col)->word = ELEM_EMPTY;
	if (network_make(cut, &arena, &n)) {
		in = network_net(&n, place->row, place->col);
		out = network_net(&n, place->row, place->col + 1);
		left = n.reader_count[out] == 0 ||
		       (in != NET_RAIL && n.first_feeder[in] == n.first_feeder[in + 1]);
	}
	arena_free(&arena);
	rung_free(cut);
	return left;
}

static struct rung *tame(struct grid_bench *bench, const struct rung *rung,
			 struct grid_at *at, const char **wrong)
{
	const struct cell contact = make(bench, "nx");
	struct grid_place place;
	struct rung *made = NULL;
	enum grid_seen seen = grid_display_find(rung, at->columns, at->row, at->col,
						&place);
	uint32_t operand;

	*wrong = NULL;
	if (seen == GRID_SEEN_EMPTY)
		return NULL;
	if (roll(8) == 0 && place.col >= 0 &&
	    rung_at(rung, place.row, place.col)->word != ELEM_PIN)
		return tame_output(bench, rung, at, wrong);
	if (at->col == at->columns - 1)
		return NULL;
	operand = rung_at(rung, place.row, place.col)->operand;
	if (seen == GRID_SEEN_CELL &&
	    rung_at(rung, place.row, place.col)->word == ELEM_WIRE &&
	    leads_left(rung, &place))
		return NULL;
	switch (roll(6)) {
	case 5:
		return is_contact(rung, &place) ? tame_move(rung, at) : NULL;
	case 0:
	case 1:
		made = grid_place(rung, at, contact, GRID_INSERT);
		if (made)
			*wrong = tame_place(rung, made, contact, false);
		return made;
	case 2:
	case 3:
		made = grid_parallel(rung, at, NULL, contact);
		if (made)
			*wrong = tame_place(rung, made, contact, true);
		return made;
	default:
		if (is_contact(rung, &place))
			made = grid_delete(rung, at);
		if (made)
			*wrong = tame_delete(rung, made, operand);
		return made;
	}
}

/* Is there a wire with another one in parallel? */
static bool has_spare_wire(const struct rung *rung)
{
	struct rung *less = rung_copy(rung);
	bool spare = false;

	for (int i = 0; i < rung->rows * rung->cols && !spare; i++) {
		struct arena arena;
		struct network n;

		if (rung->cell[i].word != ELEM_WIRE)
			continue;
		less->cell[i].word = ELEM_EMPTY;
		arena_init(&arena);
		if (network_make(less, &arena, &n))
			spare = network_net(&n, i / rung->cols, i % rung->cols) ==
				network_net(&n, i / rung->cols, i % rung->cols + 1);
		arena_free(&arena);
		less->cell[i].word = ELEM_WIRE;
	}
	rung_free(less);
	return spare;
}

static void calm(struct grid_bench *bench)
{
	static const char *const starts[] = {
		"| NO A | COIL Q0 |\n",
		"| NO A | NO B | COIL Q0 |\n| NO C ^| ^| COIL Q1 |\n",
		"| NO A | TON T1 | NO B | COIL Q0 |\n| | ^| NO C ^|\n",
		"| NO A | --- | NO B | COIL Q0 |\n| ^| NO C | ^|\n| NO D | --- ^| NC E ^|\n",
		"| NO A | CTU C1 | COIL Q0 |\n| NO B | .R |\n| NC G | COIL Q1 |\n",
	};
	struct rung *rung = grid_read(bench, starts[0]);
	const char *wrong = NULL;
	int done = 0;

	for (int i = 0; i < EDITS && !wrong; i++) {
		struct grid_at at = { .columns = grid_display_columns(rung, GRID_COLUMNS) };
		struct rung *made;

		at.row = roll(rung->rows);
		at.col = roll(at.columns);
		made = tame(bench, rung, &at, &wrong);
		if (made && !wrong && !is_clean(bench, made))
			wrong = diag_code(bench->diags.diag[0].id);
		if (made && !wrong && has_spare_wire(made))
			wrong = "the rung has a wire in parallel to another one";
		if (made && !wrong)
			wrong = grid_wrong(bench, made);
		if (wrong) {
			char text[GRID_TEXT];

			grid_write(bench, rung, text, sizeof(text));
			printf("# edit %d: %s at %d %d\n%s", i, wrong, at.row, at.col,
			       text);
			grid_write(bench, made, text, sizeof(text));
			printf("# became\n%s", text);
		}
		if (made) {
			rung_free(rung);
			rung = made;
			done++;
		}
		if (roll(60) == 0 || rung->rows > 12) {
			rung_free(rung);
			rung = grid_read(bench, starts[roll(5)]);
		}
	}
	printf("# %d done\n", done);
	CHECK(!wrong);
	CHECK(done > EDITS / 5);
	rung_free(rung);
}

int main(int argc, char **argv)
{
	struct grid_bench bench;

	if (argc > 1)
		state = strtoull(argv[1], NULL, 10);
	if (!CHECK(grid_bench_open(&bench)))
		return tap_done();
	storm(&bench);
	crowd(&bench);
	calm(&bench);
	grid_bench_close(&bench);
	return tap_done();
}
