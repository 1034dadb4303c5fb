/* SPDX-License-Identifier: MIT
 *
 * list - instruction lists as bodies of a chart, for the walker.
 *
 * Operators, parentheses, jumps, functions with one operand, calls of blocks of the
 * catalogue: what the cases of tests/golden need. A number without a type takes that of
 * the result; with LD it is an INT. ladder_build() has checked the list.
 */
#include "tests/walker/sfc.h"

#include <string.h>

#define DEPTH_MAX 16
#define LINES_MAX 100000

/* The state before an open parenthesis. */
struct opened {
	struct value result;
	enum word word;
	bool negated;
};

struct lists {
	struct walker *walker;
	struct walked_pou *walked;
	const struct sfc_body *body;
	struct value result;
	struct opened opened[DEPTH_MAX];
	int depth;
	int at, end;
	bool good;
};

static bool find(struct lists *run, uint32_t name, struct placed *out)
{
	const char *text = project_text(run->walker->project, name);
	struct placed place = walker_place(run->walker, run->walked->frame, text,
					   strlen(text));

	if (place.kind == PLACED_NOWHERE)
		run->good = false;
	return run->good && placed_find(run->walker, &place, out);
}

/* A number without a type gets the type of the result. */
static struct value operand(struct lists *run, const struct il_line *line, bool load)
{
	struct value value = { .type = IEC_BOOL };
	struct placed here;

	if (!find(run, line->operand, &here))
		return value;
	if (here.kind != PLACED_LITERAL || here.type != IEC_NONE)
		return placed_read(&here, IEC_NONE);
	return placed_read(&here, load ? IEC_INT : run->result.type);
}

static struct value inverted(struct value value)
{
	struct value out = value;

	value_compute(FN_NOT, &value, 1, &out);
	return out;
}

static struct value combined(struct lists *run, enum word word, struct value left,
			     struct value right)
{
	enum iec_type types[2] = { left.type, right.type };
	enum iec_type wide = wide_type(types, 2);
	struct value in[2] = { value_widen(left, wide), value_widen(right, wide) };
	struct value out = left;

	if (value_compute(word, in, 2, &out) != OUTCOME_GOOD)
		run->walker->errors++;
	return out;
}

static void logic(struct lists *run, const struct il_line *line)
{
	enum word word = op_function((enum op)line->op);
	bool negated = line->modifiers & MOD_N;
	struct value right;

	if (line->modifiers & MOD_PAREN) {
		if (run->depth == DEPTH_MAX) {
			run->good = false;
			return;
		}
		run->opened[run->depth++] = (struct opened){ run->result, word, negated };
		if (line->operand)
			run->result = operand(run, line, true);
		return;
	}
	right = operand(run, line, false);
	run->result = combined(run, word, run->result, negated ? inverted(right) : right);
}

static void close_parenthesis(struct lists *run)
{
	const struct opened *from = &run->opened[--run->depth];

	run->result = combined(run, from->word, from->result,
			       from->negated ? inverted(run->result) : run->result);
}

static void jump(struct lists *run, uint32_t label)
{
	struct names *names = &run->walker->project->names;
	const struct il *il = &run->walked->pou->il;

	for (int i = run->body->first; i < run->body->first + run->body->count; i++)
		if (il->line[i].kind == IL_LABEL &&
		    names_fold(names, il->line[i].operand) == names_fold(names, label))
			run->at = i;
}

static void store(struct lists *run, const struct il_line *line, struct value value)
{
	struct placed here;

	if (find(run, line->operand, &here))
		placed_write(&here, value);
}

static bool is_argument(const struct il_line *line)
{
	return line->kind == IL_ARG_IN || line->kind == IL_ARG_OUT;
}

static void call(struct lists *run, const struct il_line *line)
{
	const char *text = project_text(run->walker->project, line->operand);
	struct variable *variable = frame_variable(run->walker, run->walked->frame, text,
						   strlen(text));
	struct block *block = variable ? variable->block : NULL;
	struct placed here;

	run->good = block;
	for (int k = 0; block && k < 2; k++) {
		for (int i = 1; run->at + i < run->end && is_argument(line + i); i++) {
			const char *pin = project_text(run->walker->project, line[i].pin);
			struct value *at = &block->pin[block_pin(block, pin)];

			if (line[i].kind != (k ? IL_ARG_OUT : IL_ARG_IN) ||
			    !find(run, line[i].operand, &here))
				continue;
			if (k)
				placed_write(&here, *at);
			else
				*at = placed_read(&here, at->type);
		}
		if (!k) {
			block->called = true;
			block_call(block, run->walker->now_ns);
		}
	}
}

static void operate(struct lists *run, const struct il_line *line)
{
	bool negated = line->modifiers & MOD_N;
	bool goes = !(line->modifiers & MOD_C) || value_is_true(run->result) != negated;

	switch ((enum op)line->op) {
	case OP_LD:
		run->result = operand(run, line, true);
		if (negated)
			run->result = inverted(run->result);
		break;
	case OP_ST:
		store(run, line, negated ? inverted(run->result) : run->result);
		break;
	case OP_S:
	case OP_R:
		if (value_is_true(run->result))
			store(run, line, value_bool(line->op == OP_S));
		break;
	case OP_NOT:
		run->result = inverted(run->result);
		break;
	case OP_JMP:
		if (goes)
			jump(run, line->operand);
		break;
	case OP_RET:
		if (goes)
			run->at = run->end;
		break;
	case OP_CAL:
		if (goes)
			call(run, line);
		break;
	case OP_STP:
		run->walker->halted |= goes;
		break;
	case OP_AND:
	case OP_OR:
	case OP_XOR:
		logic(run, line);
		break;
	case OP_COUNT:
		break;
	}
}

bool walk_list(struct walker *walker, struct walked_pou *walked,
	       const struct sfc_body *body, struct value *result)
{
	struct lists run = { .walker = walker, .walked = walked, .body = body,
			     .result = { .type = IEC_BOOL }, .good = true,
			     .at = body->first, .end = body->first + body->count };

	for (int steps = 0; run.good && run.at < run.end; run.at++) {
		const struct il_line *line = &walked->pou->il.line[run.at];

		if (steps++ == LINES_MAX)
			return false;
		if (line->kind == IL_OP)
			operate(&run, line);
		else if (line->kind == IL_FN)
			run.result = combined(&run, (enum word)line->word, run.result,
					      operand(&run, line, false));
		else if (line->kind == IL_CLOSE)
			close_parenthesis(&run);
		else if (line->kind == IL_CALL)
			run.good = false;
	}
	*result = run.result;
	return run.good;
}
