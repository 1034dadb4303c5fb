/* SPDX-License-Identifier: MIT
 *
 * classic_new_name - gives each name once: what an imported project calls its own meets
 * neither a word of the language nor what the converter writes itself.
 */
#include "engine/exchange/classic/classic_convert.h"

#include "engine/base/ascii.h"
#include "engine/base/lex.h"
#include "engine/base/limits.h"
#include "engine/check/reserved.h"

#include <string.h>

/* Bytes of the character at @text if a name may hold it, else 0. */
static size_t name_char(const char *text, size_t len)
{
	size_t step = utf8_length(text, len);
	char upper = ascii_upper(*text);

	if (step > 1)
		return step;
	return (upper >= 'A' && upper <= 'Z') || ascii_digit(upper) || upper == '_';
}

/* Letters, digits and _ of @wish; anything else becomes _. */
static const char *as_name(struct conversion *c, const char *wish)
{
	size_t len = strlen(wish), at = 0, out = 0;
	char *name = arena_alloc(c->arena, len + 3);

	if (!name)
		return "_";
	if (len > LIMIT_NAME - 8)
		len = LIMIT_NAME - 8;
	if (!len || ascii_digit(wish[0]))
		name[out++] = 'N';
	while (at < len) {
		size_t step = name_char(wish + at, len - at);

		if (step)
			memcpy(name + out, wish + at, step);
		else
			name[out] = '_';
		out += step ? step : 1;
		at += step ? step : 1;
	}
	return name;
}

/* false: something has it, whatever its spelling. */
static bool claim(struct conversion *c, const char *name)
{
	int before = c->taken.count;
	uint32_t id = names_intern(&c->taken, name, strlen(name));

	return !id || (c->taken.count > before && names_fold(&c->taken, id) == id);
}

/* The number behind @base that is to be tried next. */
static int number_behind(struct conversion *c, const char *base)
{
	uint32_t id = names_find_any(&c->taken, base, strlen(base));

	while (c->tried_count <= (int)id)
		if (!arena_push(c->arena, &c->tried, &c->tried_count, sizeof(*c->tried)))
			return 0;
	return ++c->tried[id] + 1;
}

const char *name_new(struct conversion *c, const char *wish)
{
	const char *base = as_name(c, wish), *name = base;

	if (reserved_fault(base) != DIAG_COUNT)
		base = name = text_of(c, "%s_", base);
	if (reserved_fault(base) != DIAG_COUNT) /* SYS_… */
		base = name = text_of(c, "N%s", base);
	while (!claim(c, name) && !c->arena->failed)
		name = text_of(c, "%s_%d", base, number_behind(c, base));
	return name;
}

void name_reserve(struct conversion *c, const char *name)
{
	claim(c, name);
}
