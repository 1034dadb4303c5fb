/* SPDX-License-Identifier: MIT
 *
 * classic_name - finds a variable by its name in ClassicLadder, with the rows of
 * classic.def.
 */
#include "engine/trial/classic_name.h"

#include "engine/base/ascii.h"

#include <stdio.h>
#include <string.h>

#define CLASSIC_TIMER      "T"
#define CLASSIC_MONOSTABLE "Mono"
#define CLASSIC_IEC_TIMER  "TM"
#define CLASSIC_COUNTER    "C"
#define CLASSIC_REGISTER   "Reg"

struct memory_row { const char *prefix, *area; long first; int size; };
struct pin_row { const char *prefix, *attribute, *instance, *pin; bool is_bool; };

static const struct memory_row memory_rows[] = {
#define CLASSIC_MEMORY(type, prefix, area, first, size, name) \
	{ prefix, area, first, size },
#include "engine/classic.def"
};

static const struct pin_row pin_rows[] = {
#define CLASSIC_PIN(type, prefix, attribute, kind, pin, is_bool) \
	{ prefix, attribute, kind, pin, is_bool },
#define CLASSIC_STEP(type, attribute, name, pin) \
	{ "X", attribute, name, pin, sizeof(pin) == 1 },
#include "engine/classic.def"
};

/* "TM", 0, "V" of %TM0.V; the attribute may be "". */
struct parts {
	char prefix[8], attribute[4];
	long number;
};

static bool take_apart(const char *name, size_t len, struct parts *parts)
{
	size_t at = 1, from;

	memset(parts, 0, sizeof(*parts));
	if (len < 3 || name[0] != '%')
		return false;
	for (from = 0; at < len && name[at] >= 'A' && name[at] <= 'Z'; at++)
		if (from < sizeof(parts->prefix) - 1)
			parts->prefix[from++] = name[at];
	for (from = at; at < len && ascii_digit(name[at]) && at - from < 6; at++)
		parts->number = parts->number * 10 + (name[at] - '0');
	if (at == from)
		return false;
	if (at < len && name[at] == '.' && len - at - 1 < sizeof(parts->attribute)) {
		memcpy(parts->attribute, name + at + 1, len - at - 1);
		return true;
	}
	return at == len;
}

static struct location find_memory(const struct image *image, const struct parts *parts)
{
	struct location at;
	char address[32];

	for (size_t i = 0; i < sizeof(memory_rows) / sizeof(*memory_rows); i++) {
		const struct memory_row *row = &memory_rows[i];
		long bit = row->first + parts->number * row->size;

		if (strcmp(row->prefix, parts->prefix))
			continue;
		if (row->size == 1)
			snprintf(address, sizeof(address), "%%%sX%ld.%ld", row->area,
				 bit / 8, bit % 8);
		else
			snprintf(address, sizeof(address), "%%%sD%ld", row->area, bit / 8);
		at = image_find(image, address, strlen(address));
		if (at.type == IEC_DWORD)
			at.type = IEC_DINT; /* its words have a sign */
		return at;
	}
	return (struct location){ .type = IEC_NONE };
}

/* "TM0.V", or "TM0_Pause.V" for a block with a symbol. */
static struct location find_pin(const struct image *image, const struct pin_row *row,
				long number)
{
	struct symbol_cursor cursor = { 0 };
	struct symbol symbol;
	char name[40], pin[8];
	struct location at;
	size_t stem, tail;

	snprintf(name, sizeof(name), "%s%ld%s%s", row->instance, number,
		 *row->pin ? "." : "", row->pin);
	at = image_find(image, name, strlen(name));
	if (at.type != IEC_NONE)
		return at;
	stem = (size_t)snprintf(name, sizeof(name), "%s%ld_", row->instance, number);
	tail = (size_t)snprintf(pin, sizeof(pin), "%s%s", *row->pin ? "." : "", row->pin);
	while (image_next_symbol(image, &cursor, &symbol)) {
		size_t len = strlen(symbol.name);

		if (len > stem + tail && !strncmp(symbol.name, name, stem) &&
		    !strcmp(symbol.name + len - tail, pin) &&
		    (tail || !strchr(symbol.name, '.')))
			return symbol.at;
	}
	return at;
}

/* In ClassicLadder all blocks and steps exist; unused ones are 0. This is a place of
 * the system area that is never written. */
static struct location nothing(const struct image *image, bool is_bool)
{
	const char *address = is_bool ? "%SMX56.0" : "%SMD56";
	struct location at = image_find(image, address, strlen(address));

	if (!is_bool && at.type == IEC_DWORD)
		at.type = IEC_DINT;
	at.constant = true;
	return at;
}

struct location classic_name_find(const struct image *image, const char *name, size_t len)
{
	struct parts parts;

	if (!take_apart(name, len, &parts))
		return (struct location){ .type = IEC_NONE };
	if (!parts.attribute[0])
		return find_memory(image, &parts);
	for (size_t i = 0; i < sizeof(pin_rows) / sizeof(*pin_rows); i++)
		if (!strcmp(pin_rows[i].prefix, parts.prefix) &&
		    !strcmp(pin_rows[i].attribute, parts.attribute)) {
			struct location at = find_pin(image, &pin_rows[i], parts.number);

			return at.type == IEC_NONE && image->program->classic ?
			       nothing(image, pin_rows[i].is_bool) : at;
		}
	return (struct location){ .type = IEC_NONE };
}
