/* SPDX-License-Identifier: MIT
 *
 * complete - the part of the facade that completes words and tells the call around a cursor.
 *
 * It uses the project as far as it could be read, and builds nothing.
 */
#include "engine/base/name.h"
#include "engine/ladder.h"

#include "engine/check/expect.h"

#include <stdlib.h>
#include <string.h>

struct filter {
	const struct expect_place *at;
	void (*take)(void *context, const struct ladder_word *word);
	void *context;
	int words;
};

static void pass(void *context, const struct expect_word *word)
{
	struct filter *filter = context;
	const struct ladder_word out = {
		expect_kind_text(word->kind), word->text, expect_note(word),
	};
	size_t len = filter->at->prefix_len;

	if (!name_begins(filter->at->prefix, len, word->text, strlen(word->text)))
		return;
	filter->words++;
	if (filter->take)
		filter->take(filter->context, &out);
}

bool ladder_complete(struct ladder *ladder, const char *text, size_t len, int line,
		     int column,
		     void (*take)(void *context, const struct ladder_word *word),
		     void *context, struct ladder_place *place)
{
	struct project *project = ladder_read_project(ladder);
	struct filter filter = { .take = take, .context = context };
	const struct expect_taker taker = { pass, &filter };
	struct expect_place at;
	struct arena arena;
	struct scope *scope;
	bool good = false;

	if (!project)
		return false;
	arena_init(&arena);
	scope = scope_new(project, &arena);
	if (scope && expect_at(scope, text, len, line, column, &at)) {
		filter.at = &at;
		expect_offer(project, at.pou, &at.want, &taker);
		*place = (struct ladder_place){ at.prefix_len, filter.words };
		good = !arena.failed;
	}
	arena_free(&arena);
	return good;
}

char *ladder_call_at(struct ladder *ladder, const char *text, size_t len, int line, int column,
		     size_t *from, size_t *to)
{
	struct project *project = ladder_read_project(ladder);
	struct expect_call *call = project ? malloc(sizeof(*call)) : NULL;
	struct arena arena;
	struct scope *scope;
	char *found = NULL;

	arena_init(&arena);
	scope = call ? scope_new(project, &arena) : NULL;
	if (scope && expect_call(scope, text, len, line, column, call)) {
		found = strdup(call->text);
		*from = call->from;
		*to = call->to;
	}
	arena_free(&arena);
	free(call);
	return found;
}

struct function_taker {
	void (*take)(void *context, const struct ladder_word *word,
		     const struct word_row *row);
	void *context;
};

static void pass_function(void *context, const struct expect_word *word)
{
	const struct function_taker *taker = context;
	const struct ladder_word out = {
		expect_kind_text(word->kind), word->text, expect_note(word),
	};

	taker->take(taker->context, &out, word->row);
}

void ladder_functions(struct project *project, const char *begun, size_t len,
		      void (*take)(void *context, const struct ladder_word *word,
				   const struct word_row *row),
		      void *context)
{
	struct function_taker functions = { take, context };
	const struct expect_taker taker = { pass_function, &functions };

	expect_functions(project, begun, len, &taker);
}
