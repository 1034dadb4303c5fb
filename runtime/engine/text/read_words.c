/* SPDX-License-Identifier: MIT
 *
 * read_words - looks ahead in a file for the names of its functions, function blocks and
 * structures, so that they may be used above their declaration.
 *
 * It follows INCLUDE and USES, each file once. It reports nothing: the reader comes to
 * every error later.
 */
#include "engine/text/reader.h"

#include "engine/base/ascii.h"
#include "engine/model/named.h"

#include <stdlib.h>
#include <string.h>

#define FILES_MOST 1024 /* files looked into; words of further files are not known early */

struct look {
	struct reader *r;
	struct diag_list *diags;       /* heap; not reported                  */
	const char *file[FILES_MOST];
	int files;
	size_t total;
};

static const char *const heads[] = {
	"FUNCTION", "TYPE", "INCLUDE", "USES",
};

/* Does a line begin with one of these words? Most rung files have none and need no second
 * reading. */
static bool has_heads(const char *text, size_t len)
{
	const char *at = text, *end = text + len;

	while (at && at < end) {
		while (at < end && (*at == ' ' || *at == '\t' || *at == '\n' ||
				    *at == '\r'))
			at++;
		for (size_t i = 0; i < sizeof(heads) / sizeof(*heads); i++) {
			size_t n = strlen(heads[i]);

			if ((size_t)(end - at) > n && ascii_same(at, heads[i], n))
				return true;
		}
		if (at < end)
			at = memchr(at, '\n', (size_t)(end - at));
	}
	return false;
}

enum word reader_own_word(struct reader *r, uint32_t name, enum word_kind kind)
{
	const char *text = names_text(&r->project->names, name);
	struct word_row row = {
		.word = text, .kind = kind, .owner = -1,
		.place = kind == WORD_STRUCT ? PLACE_NONE : PLACE_BOX,
		.operand = kind == WORD_FB ? OPND_INSTANCE : OPND_NONE,
		.first = kind == WORD_FB ? OP_CAL : OP_LD,
		.next = kind == WORD_FB ? OP_CAL : OP_AND,
		.result = RESULT_SAME,
	};
	enum word word = words_add(&r->project->words, row);

	if (word == WORD_COUNT)
		reader_fail_many(r, DIAG_TOO_MANY, "functions, blocks and types", LIMIT_OWN_WORDS);
	return word;
}

/* A name at the cursor; the reader reports a faulty one. */
static void add_name(struct look *look, const struct lex *lex,
		     enum word_kind kind)
{
	struct reader *r = look->r;
	const struct token *token = &lex->token;
	enum word word;

	if (token->kind != TOKEN_NAME || token->len > LIMIT_NAME ||
	    memchr(token->text, '.', token->len))
		return;
	word = words_find(&r->project->words, token->text, token->len);
	if (kind != WORD_FN)
		word = words_find_type(&r->project->words, token->text, token->len);
	if (word_is_own(word) || (word != WORD_COUNT && !r->project->words.own_first &&
				  (kind == WORD_FN || !words_is_operator(token->text, token->len))))
		return;
	reader_own_word(r, reader_intern(r, token->text, token->len), kind);
}

static void skip_newlines(struct lex *lex)
{
	while (lex->token.kind == TOKEN_NEWLINE)
		lex_next(lex);
}

/* The name of a type that is no structure. */
static void add_named(struct look *look, const struct lex *lex)
{
	struct reader *r = look->r;
	const struct token *token = &lex->token;
	const uint32_t name = token->len > LIMIT_NAME ? 0 :
			      reader_intern(r, token->text, token->len);

	if (name && named_find(r->project, names_fold(&r->project->names, name)) < 0)
		reader_add_named(r, name);
}

/* From its first word to the ; behind a type, or END_STRUCT. */
static void skip_type(struct lex *lex)
{
	int open = 0;

	for (; lex->token.kind != TOKEN_END && !lex_is(lex, "END_TYPE"); lex_next(lex)) {
		const bool ends = lex_is(lex, "END_STRUCT") || lex_is(lex, "END_UNION");

		open += lex_is(lex, "STRUCT") || lex_is(lex, "UNION");
		open -= ends;
		if (open == 0 && (lex_is(lex, ";") || ends))
			return;
	}
}

/* Behind TYPE: every `Name :` up to END_TYPE, without the members of structures. */
static void look_at_types(struct look *look, struct lex *lex)
{
	while (lex->token.kind != TOKEN_END && !lex_is(lex, "END_TYPE")) {
		struct lex name = *lex;

		lex_next(lex);
		skip_newlines(lex);
		if (name.token.kind != TOKEN_NAME || !lex_is(lex, ":"))
			continue;
		lex_next(lex);
		skip_newlines(lex);
		if (lex_is(lex, "STRUCT") || lex_is(lex, "UNION"))
			add_name(look, &name, WORD_STRUCT);
		else
			add_named(look, &name);
		skip_type(lex);
	}
}

static void look_into(struct look *look, const char *file, const char *text,
		      size_t len, int depth);

static void look_at_file(struct look *look, const char *from, struct lex *lex,
			 int depth)
{
	struct reader *r = look->r;
	uint32_t name = 0;
	const char *path;
	size_t len = 0;

	if (lex->token.kind != TOKEN_STRING || !r->source ||
	    depth == LIMIT_INCLUDES || look->files == FILES_MOST)
		return;
	if (!reader_unescape(r, &lex->token, look->diags, &name) || !name)
		return;
	path = reader_path(r, from, names_text(&r->project->names, name));
	if (!path)
		return;
	for (int i = 0; i < look->files; i++)
		if (!strcmp(look->file[i], path))
			return;
	look->file[look->files++] = path;
	char *text = r->source->load(r->source->context, from,
				     names_text(&r->project->names, name), &len,
				     look->diags, (struct diag){ .file = path });
	diag_init(look->diags);
	look->total += len + 1024;
	if (text && look->total <= LIMIT_TEXT)
		look_into(look, path, text, len, depth + 1);
	free(text);
}

/* A VIEW may hold any text. */
static void skip_view(struct lex *lex)
{
	const char *end = reader_view_end(lex);

	lex->at = end ? end : lex->end;
	lex_next(lex);
}

/* Depth: at most LIMIT_INCLUDES. */
static void look_into(struct look *look, const char *file, const char *text,
		      size_t len, int depth)
{
	const bool plain = text_is_plain(text, len); /* heads stand anywhere */
	struct lex lex;
	bool begins = true; /* a line */

	if (!plain && !has_heads(text, len))
		return;
	lex_init(&lex, text, len);
	lex.newlines = true;
	while (lex_next(&lex) != TOKEN_END) {
		bool first = begins || plain;

		begins = lex.token.kind == TOKEN_NEWLINE;
		if (!first || lex.token.kind != TOKEN_NAME)
			continue;
		struct lex head = lex;

		lex_next(&head);
		if (lex_is(&head, ":"))
			continue;
		if (lex_is(&lex, "VIEW"))
			skip_view(&lex);
		else if (lex_is(&lex, "FUNCTION"))
			add_name(look, &head, WORD_FN);
		else if (lex_is(&lex, "FUNCTION_BLOCK") || lex_is(&lex, "FUNCTIONBLOCK"))
			add_name(look, &head, WORD_FB);
		else if (lex_is(&lex, "TYPE"))
			look_at_types(look, &lex);
		else if (lex_is(&lex, "INCLUDE") || lex_is(&lex, "USES"))
			look_at_file(look, file, &head, depth);
	}
}

void read_words(struct reader *r, const char *text, size_t len)
{
	struct look *look;

	if (!r->plain && !has_heads(text, len))
		return;
	look = calloc(1, sizeof(*look));
	if (look)
		look->diags = calloc(1, sizeof(*look->diags));
	if (look && look->diags) {
		look->r = r;
		diag_init(look->diags);
		look_into(look, r->place.file, text, len, 0);
	} else {
		r->no_memory = true;
	}
	if (look)
		free(look->diags);
	free(look);
}

enum word reader_take_word(struct reader *r, uint32_t name, enum word_kind kind, int owner)
{
	const char *text = names_text(&r->project->names, name);
	enum word word = kind == WORD_FN ? words_find(&r->project->words, text, strlen(text)) :
					  words_find_type(&r->project->words, text, strlen(text));
	struct word_row *row = words_own(&r->project->words, word);

	if (!row || row->owner >= 0 || row->kind != kind) {
		word = reader_own_word(r, name, kind);
		row = words_own(&r->project->words, word);
	}
	if (row)
		row->owner = owner;
	return word;
}
