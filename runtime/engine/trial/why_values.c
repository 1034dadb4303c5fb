/* SPDX-License-Identifier: MIT
 *
 * why_values - looks up names of a rung in an image.
 */
#include "engine/trial/why_values.h"

#include "engine/base/lex.h"
#include "engine/scan/value.h"

#include <stdio.h>
#include <string.h>

/* Searches the instance, the POU, then the globals. */
static struct location find(const struct why_place *at, const char *name, size_t len)
{
	const struct image *image = &at->resource->image;
	const char *near[] = {
		at->instance ? at->instance :
			project_text(at->project, at->project->pou[at->pou].name), "",
	};
	struct location found = { .type = IEC_NONE };
	char text[2 * LIMIT_NAME + 64];

	for (int i = 0; i < 2 && found.type == IEC_NONE; i++) {
		const int used = snprintf(text, sizeof(text), "%s%s%.*s", near[i],
					  *near[i] ? "." : "", (int)len, name);

		if (used > 0 && (size_t)used < sizeof(text))
			found = image_find(image, text, (size_t)used);
	}
	return found;
}

/* The instance or POU that a name belongs to; NULL: neither. */
static const char *owner_of(const struct why_place *at, const char *name, size_t len)
{
	const struct image *image = &at->resource->image;
	const char *near = at->instance ? at->instance :
		project_text(at->project, at->project->pou[at->pou].name);
	struct declared_name array;
	char text[2 * LIMIT_NAME + 64];
	const int used = snprintf(text, sizeof(text), "%s.%.*s", near, (int)len, name);

	if (used < 0 || (size_t)used >= sizeof(text))
		return NULL;
	return image_find(image, text, (size_t)used).type != IEC_NONE ||
	       image_find_array(image, text, (size_t)used, &array) ? near : NULL;
}

bool why_operand(const struct why_place *at, uint32_t operand)
{
	const struct names *names = &at->project->names;
	const struct location place = find(at, names_text(names, operand),
					   names_len(names, operand));

	return place.type == IEC_BOOL && image_get(&at->resource->image, place).i;
}

static void append(const struct why_place *at, const char *name, size_t len,
		   struct location place, char *out, size_t size)
{
	const size_t used = strlen(out);
	char value[IEC_VALUE_TEXT];

	iec_value_print(place.type, image_get(&at->resource->image, place), value,
			sizeof(value));
	/* Appends all of it or nothing. */
	if (used + len + strlen(value) + 3 < size)
		snprintf(out + used, size - used, "%s%.*s=%s", used ? " " : "",
			 (int)len, name, value);
}

/* Appends the names in an expression, or in the parameters of a box. */
static void append_names(const struct why_place *at, const char *text, size_t size_in,
			 char *out, size_t size)
{
	struct lex lex;

	lex_init(&lex, text, size_in);
	for (lex_next(&lex); lex.token.kind != TOKEN_END; lex_next(&lex)) {
		struct location place;

		if (lex.token.kind != TOKEN_NAME && lex.token.kind != TOKEN_ADDRESS)
			continue;
		place = find(at, lex.token.text, lex.token.len);
		if (place.type != IEC_NONE)
			append(at, lex.token.text, lex.token.len, place, out, size);
	}
}

static void append_pins(const struct why_place *at, const char *name,
			const struct word_row *row, char *out, size_t size)
{
	for (int i = 0; i < row->pin_count; i++) {
		const struct word_pin *pin = &row->pin[i];
		char text[2 * LIMIT_NAME + 2];
		struct location place;
		const int used = snprintf(text, sizeof(text), "%.255s.%.255s", name,
					  pin->name);

		if (pin->dir != PIN_IN && pin->dir != PIN_OUT)
			continue;
		place = find(at, text, (size_t)used);
		if (place.type != IEC_NONE)
			append(at, pin->name, strlen(pin->name), place, out, size);
	}
}

void why_values_of(const struct why_place *at, const char *text, size_t len, char *out,
		   size_t size)
{
	*out = '\0';
	append_names(at, text, len, out, size);
}

size_t why_qualify(const struct why_place *at, const char *text, size_t len, char *out,
		   size_t size)
{
	const char *copied = text;
	size_t used = 0;
	struct lex lex;

	lex_init(&lex, text, len);
	for (lex_next(&lex); used < size; lex_next(&lex)) {
		const struct token *t = &lex.token;
		const bool end = t->kind == TOKEN_END;
		const char *whole = NULL;
		const char *upto = end ? text + len : t->text;

		if (t->kind == TOKEN_NAME && (t->text == text || t->text[-1] != '.'))
			whole = owner_of(at, t->text, t->len);
		if (!end && !whole)
			continue;
		used += (size_t)snprintf(out + used, size - used, "%.*s%s%s",
					 (int)(upto - copied), copied,
					 whole ? whole : "", whole ? "." : "");
		copied = upto;
		if (end)
			break;
	}
	return used < size ? used : 0;
}

void why_values(const struct why_place *at, const struct cell *cell,
		const struct word_row *row, char *out, size_t size)
{
	const struct names *names = &at->project->names;

	*out = '\0';
	if (row->kind == WORD_FB)
		append_pins(at, names_text(names, cell->operand), row, out, size);
	else if (row->kind == WORD_FN)
		append_names(at, names_text(names, cell->args),
			     names_len(names, cell->args), out, size);
	else if (row->operand == OPND_EXPR)
		append_names(at, names_text(names, cell->operand),
			     names_len(names, cell->operand), out, size);
}
