/* SPDX-License-Identifier: MIT
 *
 * live_rung - values and power of a rung, and whether they changed: see live_map.h.
 */
#include "editor-gtk/sim/live_map.h"

#include <string.h>

#define FLASH (1 * G_USEC_PER_SEC)
#define STEPS 64   /* of a bar; smaller changes do not redraw                    */

/* ---- finding places ---- */

static void part_clear(gpointer part)
{
	g_free(((struct live_part *)part)->text);
}

static bool is_name(char c)
{
	return g_ascii_isalnum(c) || c == '_' || c == '.' || c == '#' || (c & 0x80);
}

/* `%B1` behind a dot: a part of a number. */
static bool is_part(const char *text, size_t len)
{
	return text[len] == '%' && len > 0 && text[len - 1] == '.';
}

/* The length of a name with members and constant indices, of a number, or 1. */
static size_t token_length(const char *text)
{
	size_t len = *text == '%';

	if (!is_name(*text) && !len)
		return 1;
	while (is_name(text[len]) || is_part(text, len)) {
		const char *end;

		len++;
		if (text[len] != '[')
			continue;
		end = strchr(text + len, ']');
		if (end && strspn(text + len + 1, "-0123456789, ") ==
			   (size_t)(end - text - (ptrdiff_t)len) - 1)
			len = (size_t)(end - text) + 1;
	}
	return len;
}

static void add_text(GArray *parts, const char *text, size_t len)
{
	struct live_part part = { .text = g_strndup(text, len) };
	struct live_part *last = parts->len ?
		&g_array_index(parts, struct live_part, parts->len - 1) : NULL;

	if (last && last->at.type == IEC_NONE) {
		char *both = g_strconcat(last->text, part.text, NULL);

		g_free(part.text);
		g_free(last->text);
		last->text = both;
		return;
	}
	g_array_append_val(parts, part);
}

GArray *live_parts(const struct live_map *map, const char *text)
{
	GArray *parts = g_array_new(FALSE, FALSE, sizeof(struct live_part));
	bool any = false;

	g_array_set_clear_func(parts, part_clear);
	while (*text) {
		const size_t len = token_length(text);
		struct live_part part = { .at.type = IEC_NONE };

		if (*text == '%' || g_ascii_isalpha(*text) || *text == '_' || *text & 0x80)
			part.at = live_map_find(map, text, len);
		if (part.at.type != IEC_NONE) {
			part.named = live_map_named(map, text, len);
			part.text = g_strndup(text, len);
			g_array_append_val(parts, part);
			any = true;
		} else {
			add_text(parts, text, len);
		}
		text += len;
	}
	if (!any)
		g_clear_pointer(&parts, g_array_unref);
	return parts;
}

char *live_parts_print(GArray *parts, const struct image *image)
{
	GString *text = g_string_new(NULL);
	char value[48];

	for (guint i = 0; i < parts->len; i++) {
		const struct live_part *part = &g_array_index(parts, struct live_part, i);

		if (part->at.type != IEC_NONE)
			live_named_print(part->named, part->at.type,
					 image_get(image, part->at), value, sizeof(value));
		g_string_append(text, part->at.type != IEC_NONE ? value : part->text);
	}
	return g_string_free(text, FALSE);
}

static void take_first(struct live_cell *cell)
{
	for (guint i = 0; cell->parts && i < cell->parts->len; i++) {
		const struct live_part *part =
			&g_array_index(cell->parts, struct live_part, i);

		if (part->at.type == IEC_NONE || part->at.constant)
			continue;
		cell->at = part->at;
		cell->named = part->named;
		cell->name = part->text;
		return;
	}
}

static const struct word_pin *pin_named(const struct word_row *word, const char *name)
{
	const int index = word_pin_find(word, name, strlen(name));

	return index >= 0 ? &word->pin[index] : NULL;
}

bool live_word_counts(const struct word_row *word, const char **now, const char **goal)
{
	static const char *const pair[][2] = { { "ET", "PT" }, { "CV", "PV" }, { "V", "P" } };

	for (gsize i = 0; i < G_N_ELEMENTS(pair); i++) {
		const struct word_pin *counted = pin_named(word, pair[i][0]);
		const struct word_pin *preset = pin_named(word, pair[i][1]);

		if (!counted || !preset || counted->type != preset->type ||
		    preset->dir != PIN_IN)
			continue;
		*now = pair[i][0];
		*goal = pair[i][1];
		return true;
	}
	return false;
}

/* Finds the value that a box shows: its elapsed time or count, else its first output that is no BOOL. */
static void find_count(const struct live_map *map, const struct word_row *word,
		       const char *instance, struct live_cell *cell)
{
	const char *now, *goal;

	if (live_word_counts(word, &now, &goal)) {
		cell->at = live_map_find_pin(map, instance, now);
		cell->goal = live_map_find_pin(map, instance, goal);
	}
	for (int i = 0; i < word->pin_count && cell->at.type == IEC_NONE; i++)
		if (word->pin[i].dir == PIN_OUT && word->pin[i].type != IEC_BOOL)
			cell->at = live_map_find_pin(map, instance, word->pin[i].name);
}

static void find_text(const struct live_map *map, const struct word_row *word,
		      const char *text, struct live_cell *cell)
{
	const char *sign = word->operand == OPND_ASSIGN ? strstr(text, ":=") : NULL;
	char *target;

	cell->kind = LIVE_TEXT;
	if (word->operand == OPND_ASSIGN) {
		target = g_strchomp(g_strndup(text, sign ? (gsize)(sign - text) : 0));
		cell->at = live_map_find(map, target, strlen(target));
		cell->named = live_map_named(map, target, strlen(target));
		g_free(target);
	} else {
		cell->parts = live_parts(map, text);
		take_first(cell);
	}
}

/* Does the function store a result? One with a BOOL result gives it as power instead. */
static bool stores_number(const struct live_rung *rung, const char *args)
{
	const char *out = strstr(args, "OUT=>");
	struct location at;

	if (!out)
		return false;
	out += strlen("OUT=>");
	at = live_map_find(rung->map, out, token_length(out));
	return at.type != IEC_NONE && at.type != IEC_BOOL;
}

/* The operand of a contact or a coil. Of a bit, which cannot be set alone, the number. */
static void find_operand(const struct live_map *map, const char *operand, struct live_cell *cell)
{
	const struct location at = live_map_find(map, operand, strlen(operand));
	const char *dot = strrchr(operand, '.');
	char *name;

	cell->at = at;
	if (!at.number || !dot)
		return;
	name = g_strndup(operand, (gsize)(dot - operand));
	cell->at = live_map_find(map, name, strlen(name));
	cell->bit = (uint8_t)(at.first + 1);
	cell->name = g_intern_string(name);
	g_free(name);
}

static void find_cell(struct live_rung *rung, int row, int col)
{
	const struct cell *shown = rung_at(rung->shown, row, col);
	const struct word_row *word = words_row(&rung->project->words,
						(enum word)shown->word);
	const char *operand = project_text(rung->project, shown->operand);
	struct live_cell *cell = &rung->cell[row * rung->cols + col];

	if (word->kind == WORD_FB) {
		cell->kind = LIVE_BOX;
		find_count(rung->map, word, operand, cell);
	} else if (word->kind != WORD_ELEM) {
		cell->kind = LIVE_BOX;
		cell->fails = word->kind == WORD_FN && stores_number(rung,
			project_text(rung->project, shown->args));
	} else if (word->operand == OPND_BOOL_R || word->operand == OPND_BOOL_W) {
		cell->kind = word->operand == OPND_BOOL_R ? LIVE_CONTACT : LIVE_COIL;
		cell->edge = word->edge != EDGE_NONE;
		cell->inverse = cell->kind == LIVE_CONTACT && word->negate;
		find_operand(rung->map, operand, cell);
	} else if (word->operand == OPND_EXPR || word->operand == OPND_ASSIGN) {
		find_text(rung->map, word, operand, cell);
		cell->fails = word->operand == OPND_ASSIGN;
	}
}

struct live_rung *live_rung_new(const struct live_map *map, const struct project *project,
				const struct rung *shown, int number)
{
	struct live_rung *rung = g_new0(struct live_rung, 1);
	const int cells = shown->rows * shown->cols;

	*rung = (struct live_rung){
		.rows = shown->rows, .cols = shown->cols, .number = number, .fresh = true,
		.bits = g_new0(uint8_t, cells), .cell = g_new0(struct live_cell, cells),
		.map = map, .project = project, .shown = shown,
	};
	for (int i = 0; i < cells; i++) {
		rung->cell[i].in = rung->cell[i].out = LIVE_NOWHERE;
		rung->cell[i].part = -1;
		rung->cell[i].name = "";
		find_cell(rung, i / rung->cols, i % rung->cols);
	}
	if (number >= 0)
		live_map_power(map, rung);
	return rung;
}

void live_rung_free(struct live_rung *rung)
{
	if (!rung)
		return;
	for (int i = 0; i < rung->rows * rung->cols; i++)
		g_clear_pointer(&rung->cell[i].parts, g_array_unref);
	g_free(rung->bits);
	g_free(rung->cell);
	g_free(rung);
}

/* ---- looking ---- */

union iec_value live_cell_bit(const struct live_cell *cell, union iec_value number)
{
	return cell->bit ? (union iec_value){ .i = (int64_t)((uint64_t)number.i >> (cell->bit - 1) & 1) } : number;
}

union iec_value live_cell_switched(const struct live_cell *cell, union iec_value number)
{
	const struct iec_type_row *type = iec_type_row(cell->at.type);
	const unsigned int unused = 64 - 8 * type->size;
	uint64_t value;

	if (!cell->bit)
		return (union iec_value){ .i = !number.i };
	value = ((uint64_t)number.i ^ (uint64_t)1 << (cell->bit - 1)) << unused;
	return (union iec_value){ .i = type->low < 0 ? (int64_t)value >> unused : (int64_t)(value >> unused) };
}

static bool is_same(union iec_value a, union iec_value b)
{
	return memcmp(&a, &b, sizeof(a)) == 0;
}

static void print_parts(const struct live_cell *cell, const struct image *image, char *out,
			size_t size)
{
	char *text = live_parts_print(cell->parts, image);

	g_strlcpy(out, text, size);
	if (strlen(text) >= size)
		*g_utf8_find_prev_char(out, out + strlen(out)) = '\0';
	g_free(text);
}

static guint64 number_of(const struct image *image, struct location at)
{
	const union iec_value value = image_get(image, at);
	guint64 sum = 5381;

	if (at.type != IEC_STRING)
		return (guint64)value.i;
	for (int i = 0; i < value.s->length; i++)
		sum = sum * 33 + (guchar)value.s->text[i];
	return sum;
}

/* A hash of all values of the parts. */
static guint64 sum_of(const struct live_cell *cell, const struct image *image)
{
	guint64 sum = 1469598103934665603u;

	for (guint i = 0; i < cell->parts->len; i++) {
		const struct live_part *part =
			&g_array_index(cell->parts, struct live_part, i);

		if (part->at.type != IEC_NONE)
			sum = (sum ^ number_of(image, part->at)) * 1099511628211u;
	}
	return sum;
}

static bool is_forced(const struct live_cell *cell, const struct image *image)
{
	if (image->force_count == 0)
		return false;
	for (guint i = 0; cell->parts && i < cell->parts->len; i++) {
		const struct live_part *part =
			&g_array_index(cell->parts, struct live_part, i);

		if (part->at.type != IEC_NONE && image_is_forced(image, part->at))
			return true;
	}
	return cell->at.type != IEC_NONE && image_is_forced(image, cell->at);
}

static float part_of(const struct live_cell *cell)
{
	double part;

	if (cell->goal.type == IEC_NONE)
		return -1;
	part = cell->aim.i > 0 ? (double)cell->value.i / (double)cell->aim.i : 0;
	return (float)((int)(CLAMP(part, 0, 1) * STEPS + 0.5)) / STEPS;
}

/* Updates text and bar of a cell. True: they changed. */
static bool look_at_value(struct live_cell *cell, const struct image *image, bool first)
{
	const union iec_value before = cell->value, aim = cell->aim;
	char text[sizeof(cell->text)];
	const float part = cell->part;
	bool other;

	if (cell->at.type != IEC_NONE && cell->at.type != IEC_STRING)
		cell->value = live_cell_bit(cell, image_get(image, cell->at));
	if (cell->goal.type != IEC_NONE)
		cell->aim = image_get(image, cell->goal);
	if (cell->parts) {
		const guint64 sum = sum_of(cell, image);

		if (sum == cell->sum && !first)
			return false;
		cell->sum = sum;
		print_parts(cell, image, text, sizeof(text));
	} else if (cell->at.type == IEC_NONE ||
		   cell->kind == LIVE_CONTACT || cell->kind == LIVE_COIL ||
		   (!first && cell->at.type != IEC_STRING &&
		    is_same(before, cell->value) && is_same(aim, cell->aim))) {
		return false;
	} else if (cell->goal.type != IEC_NONE) {
		live_count_print(cell->at.type, cell->value, cell->aim, text, sizeof(text));
	} else {
		live_named_print(cell->named, cell->at.type, image_get(image, cell->at),
				 text, sizeof(text));
	}
	cell->part = part_of(cell);
	other = strcmp(text, cell->text) != 0 || cell->part != part;
	memcpy(cell->text, text, sizeof(text));
	return other;
}

static uint8_t power_of(const struct live_cell *cell, const struct resource *resource)
{
	const uint8_t *memory = resource->image.memory;

	if (cell->in == LIVE_NOWHERE || resource->state == STATE_STOP ||
	    resource->scans == 0)
		return 0;
	return (uint8_t)(LIVE_KNOWN | (memory[cell->in] ? LIVE_IN : 0) |
			 (memory[cell->out] ? LIVE_OUT : 0));
}

/* The scan may have read another value than the one after it, if the variable is forced or
 * written further down. The power behind the contact tells which, until a person sets another
 * value. */
static bool tells_power(const struct live_cell *cell, uint8_t power)
{
	return cell->edge || cell->at.type == IEC_NONE ||
	       (power & LIVE_IN && is_same(cell->value, cell->scanned));
}

static bool is_closed(const struct live_cell *cell, uint8_t power)
{
	switch (cell->kind) {
	case LIVE_CONTACT:
		if (tells_power(cell, power))
			return power & LIVE_OUT;
		return (cell->value.i != 0) != cell->inverse;
	case LIVE_COIL:
		return cell->at.type == IEC_NONE ? power & LIVE_IN : cell->value.i != 0;
	case LIVE_TEXT:
		return cell->parts && power & LIVE_OUT;
	case LIVE_NOTHING: case LIVE_BOX:
		break;
	}
	return false;
}

/* A value that changes all the time is marked only when it begins to change. */
static bool is_fresh(struct live_cell *cell, bool changed, gint64 now, bool flash)
{
	if (changed) {
		if (flash && now - cell->changed > FLASH)
			cell->flash = now;
		cell->changed = now;
	}
	return flash && cell->flash && now - cell->flash < FLASH;
}

static uint8_t look_at(struct live_rung *rung, struct live_cell *cell,
		       const struct resource *resource, gint64 now, bool flash, bool *other,
		       bool scanned)
{
	const union iec_value before = cell->value;
	const guint64 sum = cell->sum;
	uint8_t bits = power_of(cell, resource);
	bool changed;

	*other |= look_at_value(cell, &resource->image, rung->fresh);
	if (scanned)
		cell->scanned = cell->value;
	changed = !rung->fresh && cell->kind != LIVE_BOX &&
		(!is_same(before, cell->value) || sum != cell->sum);
	if (is_closed(cell, bits))
		bits |= LIVE_CLOSED;
	if (is_forced(cell, &resource->image))
		bits |= LIVE_FORCED;
	if (cell->fails && (bits & (LIVE_IN | LIVE_OUT)) == LIVE_IN)
		bits |= LIVE_FAILED;
	if (is_fresh(cell, changed, now, flash)) {
		bits |= LIVE_FRESH;
		rung->until = rung->until ? MIN(rung->until, cell->flash + FLASH) :
			      cell->flash + FLASH;
	}
	return bits;
}

unsigned int live_rung_look(struct live_rung *rung, const struct resource *resource,
			    gint64 now, bool flash)
{
	unsigned int changed = rung->fresh ? LIVE_OTHER_VALUE | LIVE_OTHER_STATE : LIVE_SAME;
	const bool scanned = rung->fresh || rung->scans != resource->scans ||
			     rung->start_ns != resource->start_ns;
	bool other = false;

	rung->until = 0;
	rung->scans = resource->scans;
	rung->start_ns = resource->start_ns;
	for (int i = 0; i < rung->rows * rung->cols; i++) {
		struct live_cell *cell = &rung->cell[i];
		uint8_t bits;

		if (cell->kind == LIVE_NOTHING && cell->in == LIVE_NOWHERE)
			continue;
		bits = look_at(rung, cell, resource, now, flash, &other, scanned);
		if (bits != rung->bits[i])
			changed |= LIVE_OTHER_VALUE;
		if ((bits ^ rung->bits[i]) & (LIVE_CLOSED | LIVE_FORCED | LIVE_FAILED))
			changed |= LIVE_OTHER_STATE;
		rung->bits[i] = bits;
	}
	rung->fresh = false;
	return changed | (other ? LIVE_OTHER_VALUE | LIVE_OTHER_TEXT : 0);
}

bool live_rung_value(void *context, int row, int col, struct live_value *out)
{
	const struct live_rung *rung = context;
	const struct live_cell *cell = &rung->cell[row * rung->cols + col];

	if (!cell->text[0])
		return false;
	g_strlcpy(out->text, cell->text, sizeof(out->text));
	out->part = cell->part;
	return true;
}
