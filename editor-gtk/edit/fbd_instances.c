/* SPDX-License-Identifier: MIT
 *
 * fbd_instances - instances in lines that are to be pasted; see fbd_instances.h.
 */
#include "editor-gtk/edit/fbd_instances.h"

#include "editor-gtk/edit/entry_names.h"
#include "engine/base/lex.h"
#include "engine/base/name.h"
#include "engine/base/sink.h"
#include "engine/model/st.h"

#include <stdio.h>
#include <string.h>

/* The next name that is called, `Delay(`, but not a member, as in `Line[1].Delay(`. False: there is none. */
static bool next_call(struct lex *lex, struct token *name)
{
	struct token last = { .kind = TOKEN_END };
	bool behind_dot = false;

	while (lex_next(lex) != TOKEN_END) {
		if (last.kind == TOKEN_NAME && !behind_dot && lex_is(lex, "(")) {
			*name = last;
			return true;
		}
		behind_dot = last.kind != TOKEN_END && last.len == 1 && *last.text == '.';
		last = lex->token;
	}
	return false;
}

static bool is_called(const struct project *project, const struct pou *pou, const struct token *name)
{
	for (int i = 0; pou->st && i < pou->st->count; i++) {
		const char *text = project_text(project, pou->st->item[i].text);
		struct token called;
		struct lex lex;

		lex_init(&lex, text, strlen(text));
		while (pou->st->item[i].kind != ST_COMMENT && next_call(&lex, &called))
			if (called.len == name->len && name_is(name->text, called.text, called.len))
				return true;
	}
	return false;
}

bool fbd_instance_again(struct project *project, int pou, const char *text, char name[LIMIT_NAME + 1],
			const char **type)
{
	const struct entry_place place = { .project = project, .pou = pou };
	struct entry_target target;
	struct token called;
	struct lex lex;

	lex_init(&lex, text, strlen(text));
	while (next_call(&lex, &called)) {
		const struct word_row *row;

		if (called.len > LIMIT_NAME || memchr(called.text, '.', called.len))
			continue;
		entry_target_find(&place, called.text, called.len, &target);
		row = target.means == MEANS_INSTANCE && !target.array ? words_row(&project->words, target.word) : NULL;
		snprintf(name, LIMIT_NAME + 1, "%.*s", (int)called.len, called.text);
		called.text = name;
		if (!row || row->kind != WORD_FB || !is_called(project, entry_pou(&place), &called))
			continue;
		*type = row->word;
		return true;
	}
	return false;
}

void fbd_instance_stem(const char *name, char stem[LIMIT_NAME + 1])
{
	size_t len = strlen(name);

	while (len > 1 && name[len - 1] >= '0' && name[len - 1] <= '9')
		len--;
	snprintf(stem, LIMIT_NAME + 1, "%.*s", (int)len, name);
}

char *fbd_name_replaced(const char *text, const char *name, const char *to)
{
	struct sink_memory memory;
	const char *done = text;
	bool behind_dot = false;
	struct lex lex;

	sink_memory_init(&memory);
	const struct sink sink = sink_to_memory(&memory);

	lex_init(&lex, text, strlen(text));
	while (lex_next(&lex) != TOKEN_END) {
		const size_t head = lex.token.kind == TOKEN_NAME && !behind_dot ?
			name_head(name, strlen(name), lex.token.text, lex.token.len) : 0;

		if (head) {
			sink_write(&sink, done, (size_t)(lex.token.text - done));
			sink_text(&sink, to);
			done = lex.token.text + head;
		}
		behind_dot = lex_is(&lex, ".");
	}
	sink_text(&sink, done);
	if (!memory.failed)
		return memory.text;
	sink_memory_free(&memory);
	return NULL;
}
