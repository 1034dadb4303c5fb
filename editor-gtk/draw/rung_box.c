/* SPDX-License-Identifier: MIT
 *
 * rung_box - pins and sizes of boxes; see rung_box.h. Pins have the same order as in
 * show/show_box.c.
 */
#include "editor-gtk/draw/rung_box.h"
#include "engine/base/lex.h"
#include "engine/base/name.h"
#include "engine/model/args.h"

#include <glib.h>
#include <string.h>

#define VALUE_BOUND 180   /* px, most of a value at a pin; on paper more     */
#define NAME_BOUND  140   /* px, most of a name of a pin; twice that of a box, on paper four
			     times */
#define PADDING     6     /* px from a side to the texts inside                 */
#define LEAST_INNER 70
#define VALUE_INNER 100 /* px: "12.5 s / 20 s" fits                       */
#define LEAD        14    /* px of a side with nothing connected                */

static bool side_has(const struct rung_side *side, const char *name, size_t len)
{
	for (int i = 0; i < side->count; i++)
		if (name_same(side->pin[i].name, side->pin[i].name_len, name, len))
			return true;
	return false;
}

static float value_most(const struct drafting *drafting)
{
	return drafting->all_comments ? 2.5f * VALUE_BOUND : VALUE_BOUND;
}

static void side_add(const struct drafting *drafting, struct rung_side *side,
		     struct rung_pin pin)
{
	struct lettering *lettering = drafting->lettering;

	if (side->count == BOX_PIN_MOST) {
		side->cut = true;
		return;
	}
	side->pin[side->count++] = pin;
	side->others += !pin.power;
	side->name_width = MAX(side->name_width,
			       lettering_fit(lettering, LETTER_PIN, pin.name,
					     (ptrdiff_t)pin.name_len, NAME_BOUND).width);
	if (pin.value)
		side->value_width = MAX(side->value_width,
			lettering_fit(lettering, LETTER_OPERAND, pin.value,
				      (ptrdiff_t)pin.value_len,
				      value_most(drafting)).width);
}

static void add_power(const struct drafting *drafting, struct rung_side *side,
		      const char *name)
{
	side_add(drafting, side, (struct rung_pin){ .name = name, .power = true,
						    .name_len = strlen(name) });
}

/* The initial value of an input in the declaration of the instance: 20 of `(P := 20)`. */
static void take_declared(const struct drafting *drafting, const struct rung_box *box,
			  struct rung_pin *pin)
{
	const char *name = project_text(drafting->project, box->cell->operand);
	const char *init = drafting->names ? grid_names_find(drafting->names, name).init : "";
	struct lex lex;
	int depth = 0;

	lex_init(&lex, init, strlen(init));
	while (!pin->value && lex_next(&lex) != TOKEN_END) {
		depth += lex_is(&lex, "(") - lex_is(&lex, ")");
		if (depth != 1 || !name_same(lex.token.text, lex.token.len, pin->name, pin->name_len))
			continue;
		lex_next(&lex);
		if (!lex_accept(&lex, ":="))
			continue;
		for (pin->value = lex.token.text; lex.token.kind != TOKEN_END &&
		     (depth > 1 || (!lex_is(&lex, ",") && !lex_is(&lex, ")"))); lex_next(&lex)) {
			depth += lex_is(&lex, "(") - lex_is(&lex, ")");
			pin->value_len = (size_t)(lex.token.text + lex.token.len - pin->value);
		}
	}
}

/* The time of the scan, which an import passes to its timers. */
static bool is_scan_time(const char *value, size_t len)
{
	const char *word = sys_row(SYS_CYCLE)->name;

	return value && name_same(value, len, word, strlen(word));
}

/* An input that a person does not set: the time of the scan, or an option of a word of the
 * catalogue that has its usual value. */
static bool is_inner(const struct rung_box *box, const struct word_pin *of,
		     const struct rung_pin *pin)
{
	return is_scan_time(pin->value, pin->value_len) ||
	       (box->row->kind == WORD_FB && box->cell->word < WORD_COUNT && !pin->value &&
		of && of->type == IEC_BOOL && of->has_init);
}

/* Adds a pin of the catalogue's row, with the value written for it if there is one. */
static void add_named(const struct drafting *drafting, struct rung_box *box, bool output,
		      const char *name, const struct word_pin *of)
{
	struct rung_pin pin = { .name = name, .name_len = strlen(name) };
	struct arg arg;

	if (args_find_side(project_text(drafting->project, box->cell->args), output, name,
			   pin.name_len, &arg)) {
		pin.value = arg.value;
		pin.value_len = arg.value_len;
		pin.inverse = arg.inverse;
	} else if (!output && box->row->kind == WORD_FB) {
		take_declared(drafting, box, &pin);
	}
	if (output || !is_inner(box, of, &pin))
		side_add(drafting, output ? &box->out : &box->in, pin);
}

/* Adds parameters that are not in the row: IN3, mistakes, and those of pins that carry
 * power. */
static void add_others(const struct drafting *drafting, struct rung_box *box)
{
	const char *at = project_text(drafting->project, box->cell->args);
	struct arg arg;

	while (args_next(&at, &arg)) {
		struct rung_side *side = arg.output ? &box->out : &box->in;
		bool shown = !arg.output && is_scan_time(arg.value, arg.value_len);

		for (int i = 0; i < side->count; i++)
			shown |= side->pin[i].value == arg.value;
		if (!shown)
			side_add(drafting, side, (struct rung_pin){
				.name = arg.pin, .name_len = arg.pin_len,
				.value = arg.value, .value_len = arg.value_len,
				.inverse = arg.inverse });
	}
}

static const char *power_pin(const struct word_row *row, enum pin_dir dir)
{
	if (row->kind == WORD_FN)
		return dir == PIN_IN ? "EN" : "ENO";
	int pin = word_first_bool(row, dir);
	return pin < 0 ? dir == PIN_IN ? "EN" : "ENO" : row->pin[pin].name;
}

static void add_pins(const struct drafting *drafting, struct rung_box *box)
{
	const struct word_row *row = box->row;

	for (int i = 0; i < row->pin_count; i++) {
		const struct word_pin *pin = &row->pin[i];
		bool output = pin->dir == PIN_OUT;
		struct rung_side *side = output ? &box->out : &box->in;

		if (pin->dir != PIN_VAR && pin->dir != PIN_NONE &&
		    !side_has(side, pin->name, strlen(pin->name)))
			add_named(drafting, box, output, pin->name, pin);
		/* V of the old timer of ClassicLadder is an input that the block sets */
		box->value |= row->kind == WORD_FB && pin->type != IEC_BOOL &&
			      (output || (pin->type == IEC_DINT && strcmp(pin->name, "V") == 0));
	}
	if (row->kind == WORD_FN && !word_is_test(row))
		add_named(drafting, box, true, "OUT", NULL);
	add_others(drafting, box);
}

static float width_of(const struct drafting *drafting, enum letter letter,
		      const char *text, float bound)
{
	return lettering_fit(drafting->lettering, letter, text, -1, bound).width;
}

static void measure(const struct drafting *drafting, struct rung_box *box)
{
	const char *instance = project_text(drafting->project, box->cell->operand);
	float names = box->in.name_width + 14 + box->out.name_width;
	float type = width_of(drafting, LETTER_TYPE, box->row->word, 2 * NAME_BOUND);
	float value = box->in.value_width, result = box->out.value_width;

	box->inner = MAX(MAX(names, type) + 2 * PADDING,
			 box->value ? VALUE_INNER : LEAST_INNER);
	box->lead = value > 0 ? value + BOX_STUB + 10 : LEAD;
	box->tail = result > 0 ? result + BOX_STUB + 10 : LEAD;
	/* The name is centred on the frame alone, without the values. */
	float name = width_of(drafting, LETTER_SYMBOL, instance, box->name_most) / 2 + 4;
	box->left = MAX(box->lead + box->inner / 2, name);
	box->right = MAX(box->inner / 2 + box->tail, name);
}

void rung_box_make(const struct drafting *drafting, const struct rung *rung, int row,
		   int col, struct rung_box *box)
{
	memset(box, 0, sizeof(*box));
	box->cell = rung_at(rung, row, col);
	box->row = words_row(&drafting->project->words, box->cell->word);
	box->top = row;
	box->last = row + rung_height(rung, row, col) - 1;
	box->col = col;
	box->name_most = (drafting->all_comments ? 4 : 2) * NAME_BOUND;
	box->value_most = value_most(drafting);
	add_power(drafting, &box->in, power_pin(box->row, PIN_IN));
	add_power(drafting, &box->out, power_pin(box->row, PIN_OUT));
	for (int r = row + 1; r <= box->last; r++)
		add_power(drafting, &box->in,
			  project_text(drafting->project, rung_at(rung, r, col)->operand));
	add_pins(drafting, box);
	measure(drafting, box);
}

void rung_box_place(struct rung_box *box, const struct rung_row *row, float column_x,
		    float column_width)
{
	float first = row[box->top].wire, last = row[box->last].wire - first;
	int powered = box->in.count - box->in.others;

	for (int i = 0; i < box->in.count; i++)
		box->in.pin[i].y = i < powered ? row[box->top + i].wire - first :
				   last + (float)(i - powered + 1) * BOX_LINE;
	for (int i = 0; i < box->out.count; i++)
		box->out.pin[i].y = (float)i * BOX_LINE;
	float left = last + (float)box->in.others * BOX_LINE;
	float right = (float)(box->out.count - 1) * BOX_LINE;
	box->bottom = MAX(left, right) + BOX_BELOW + (box->value ? BOX_VALUE : 0);
	box->x = column_x + box->left - box->inner / 2 +
		 (column_width - box->left - box->right) / 2;
}

void rung_box_at(const struct drafting *drafting, const struct rung_layout *layout, int row,
		 int col, struct rung_box *box)
{
	/* A box is no output, so its column is the shown one. */
	rung_box_make(drafting, layout->rung, row, col, box);
	rung_box_place(box, layout->row, layout->column_x[col], layout->column_width[col]);
}
