/* SPDX-License-Identifier: MIT
 *
 * words_time - random arithmetic on times and dates, random functions of texts.
 */
#include "tests/walker/words.h"

#include <string.h>

/* A TIME made of dates, or of a time and a number. */
void random_timely(struct builder *builder, int depth)
{
	static const char *const dated[] = { "TIME_OF_DAY", "DATE", "DATE_AND_TIME" };
	static const char *const factor[] = {
		"SINT", "INT", "UDINT", "LINT", "ULINT", "REAL", "LREAL", "DINT",
	};
	struct random_source *source = builder->source;
	const char *type = dated[random_below(source, 3)];
	const char *by = factor[random_below(source, 8)];

	if (random_chance(source, 40)) {
		number(builder, type, depth, true);
		words_put(builder, " - ");
		number(builder, type, depth, true);
		return;
	}
	number(builder, "TIME", depth, true);
	words_put(builder, random_chance(source, 50) ? " * %s" : " / %s",
	    random_chance(source, 30) ? random_chance(source, 50) ? "3" : "0.5" :
	    variable(source, by, false));
}

/* A time of day or a moment some time before or after another; a date as it is. */
void random_moment(struct builder *builder, const char *type, int depth)
{
	struct random_source *source = builder->source;

	if (strcmp(type, "DATE") == 0) {
		words_put(builder, "%s", term(source, type, false));
		return;
	}
	number(builder, type, depth, true);
	words_put(builder, random_chance(source, 50) ? " + " : " - ");
	number(builder, "TIME", depth, true);
}

static const char *text_of(struct random_source *source)
{
	if (random_chance(source, 25))
		return literal(source, "STRING[9]");
	return variable(source, random_chance(source, 70) ? "STRING[9]" : "STRING[4]",
			false);
}

/* A length or position: mostly a valid one. */
static const char *place_of(struct random_source *source)
{
	static const char *const usual[] = { "1", "2", "3", "0", "4" };

	return random_chance(source, 75) ? usual[random_below(source, 5)] :
	       variable(source, random_chance(source, 50) ? "SINT" : "ULINT", false);
}

/* A letter for each pin: T a text, N a length or position. */
void random_text(struct builder *builder)
{
	static const struct { const char *word, *pins[4]; } words[] = {
		{ "LEN", { "TIN" } }, { "LEFT", { "TIN", "NL" } },
		{ "RIGHT", { "TIN", "NL" } }, { "MID", { "TIN", "NL", "NP" } },
		{ "CONCAT", { "TIN1", "TIN2" } }, { "CONCAT", { "TIN1", "TIN2", "TIN3" } },
		{ "INSERT", { "TIN1", "TIN2", "NP" } },
		{ "DELETE", { "TIN", "NL", "NP" } },
		{ "REPLACE", { "TIN1", "TIN2", "NL", "NP" } },
		{ "FIND", { "TIN1", "TIN2" } }, { "LT", { "TIN1", "TIN2" } },
		{ "EQ", { "TIN1", "TIN2" } }, { "MOVE", { "TIN" } },
	};
	struct random_source *source = builder->source;
	uint32_t which = random_below(source, sizeof(words) / sizeof(*words));
	const char *word = words[which].word;
	bool test = strlen(word) == 2;

	words_put(builder, "%s", word);
	for (int i = 0; i < 4 && words[which].pins[i]; i++)
		words_put(builder, " %s:=%s", words[which].pins[i] + 1,
		    words[which].pins[i][0] == 'T' ? text_of(source) : place_of(source));
	if (strcmp(word, "LEN") == 0 || strcmp(word, "FIND") == 0)
		words_put(builder, " OUT=>%s", variable(source, "INT", true));
	else if (!test)
		words_put(builder, " OUT=>%s", variable(source, random_chance(source, 70) ?
						  "STRING[9]" : "STRING[4]", true));
}
