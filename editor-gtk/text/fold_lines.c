/* SPDX-License-Identifier: MIT
 *
 * fold_lines - blocks that can be folded: see fold_lines.h.
 */
#include "editor-gtk/text/fold_lines.h"

#include "engine/base/ascii.h"

#include <string.h>

#define LONGEST 16 /* letters of a word that counts                             */

/* ---- words ---- */

enum word_place {
	PLACE_ANY,   /* a word of the language                                  */
	PLACE_FIRST, /* may be a name elsewhere: it counts where a line begins   */
};

/* What END_ and the name ends. */
static const struct word {
	const char *word, *end;
	enum word_place place;
} words[] = {
	{ "IF", "IF", PLACE_ANY }, { "CASE", "CASE", PLACE_ANY }, { "FOR", "FOR", PLACE_ANY },
	{ "WHILE", "WHILE", PLACE_ANY }, { "REPEAT", "REPEAT", PLACE_ANY },
	{ "STRUCT", "STRUCT", PLACE_ANY }, { "VAR", "VAR", PLACE_FIRST },
	{ "VAR_INPUT", "VAR", PLACE_FIRST }, { "VAR_OUTPUT", "VAR", PLACE_FIRST },
	{ "VAR_IN_OUT", "VAR", PLACE_FIRST }, { "VAR_EXTERNAL", "VAR", PLACE_FIRST },
	{ "VAR_GLOBAL", "VAR", PLACE_FIRST }, { "VAR_TEMP", "VAR", PLACE_FIRST },
	{ "VAR_ACCESS", "VAR", PLACE_FIRST }, { "VAR_CONFIG", "VAR", PLACE_FIRST },
	{ "TYPE", "TYPE", PLACE_FIRST }, { "PROGRAM", "PROGRAM", PLACE_FIRST },
	{ "FUNCTION", "FUNCTION", PLACE_FIRST },
	{ "FUNCTION_BLOCK", "FUNCTION_BLOCK", PLACE_FIRST },
	{ "SUBROUTINE", "SUBROUTINE", PLACE_FIRST },
	{ "CONFIGURATION", "CONFIGURATION", PLACE_FIRST }, { "RESOURCE", "RESOURCE", PLACE_FIRST },
	{ "STEP", "STEP", PLACE_FIRST }, { "INITIAL_STEP", "STEP", PLACE_FIRST },
	{ "MACRO_STEP", "STEP", PLACE_FIRST }, { "TRANSITION", "TRANSITION", PLACE_FIRST },
	{ "ACTION", "ACTION", PLACE_FIRST },
};

static bool in_name(char c)
{
	return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || ascii_digit(c) || c == '_' ||
	       (guchar)c >= 0x80;
}

static const char *skip_blanks(const char *at)
{
	while (*at == ' ' || *at == '\t')
		at++;
	return at;
}

/* `Step := 3` and `Step.X` are a variable; `PROGRAM Slow WITH Task : Main` is no body. */
static bool is_name(const struct word *word, const char *behind)
{
	behind = skip_blanks(behind);
	if (word->place == PLACE_ANY)
		return false;
	if (*behind == '.' || *behind == ';' || *behind == '(' || *behind == '[' ||
	    (*behind == ':' && behind[1] == '='))
		return true;
	if (strcmp(word->word, "PROGRAM") != 0)
		return false;
	while (*behind && *behind != '\n' && *behind != '\r' && *behind != ':' && *behind != '(')
		behind++;
	return *behind == ':';
}

/* The block that a word begins; NULL: none. */
static const char *begun(const char *at, gsize len, bool first)
{
	for (gsize i = 0; len < LONGEST && i < G_N_ELEMENTS(words); i++)
		if (strlen(words[i].word) == len && ascii_same(words[i].word, at, len) &&
		    (first || words[i].place == PLACE_ANY))
			return is_name(&words[i], at + len) ? NULL : words[i].end;
	return NULL;
}

/* The block that it ends; NULL: none. */
static const char *ended(const char *at, gsize len)
{
	if (len < 6 || len >= LONGEST + 4 || !ascii_same(at, "END_", 4))
		return NULL;
	for (gsize i = 0; i < G_N_ELEMENTS(words); i++)
		if (strlen(words[i].end) == len - 4 && ascii_same(words[i].end, at + 4, len - 4))
			return words[i].end;
	return NULL;
}

/* ---- lines ---- */

static bool ends_line(const char *at)
{
	return *at == '\0' || *at == '\n' || *at == '\r' ||
	       ((guchar)at[0] == 0xe2 && (guchar)at[1] == 0x80 && (guchar)at[2] == 0xa9);
}

const char *fold_next(const char *line)
{
	while (!ends_line(line))
		line++;
	return *line == '\0' ? NULL : *line == '\r' && line[1] == '\n' ? line + 2 :
	       (guchar)*line == 0xe2 ? line + 3 : line + 1;
}

/* The blocks that are open while lines are read. */
struct open {
	const char *end;  /* the block; "(": a comment                          */
	int line;
};

struct reader {
	GArray *open;         /* of struct open, outermost first; NULL: one line is looked at */
	int line;
	int *ends;            /* by line                                        */
	int first;            /* blocks of that line that are open               */
	int depth;            /* without @open: blocks of the line that are open  */
	bool part;            /* what is around the first block is not known      */
	bool first_word, slashes, any;
	struct fold_state state;
};

static void begin(struct reader *reader, const char *end)
{
	const struct open open = { end, reader->line };

	reader->depth++;
	if (!reader->open)
		return;
	g_array_append_val(reader->open, open);
	reader->first += reader->line == 0;
}

/* The line @last is the last one of the innermost block. */
static void pop(struct reader *reader, int last)
{
	const struct open *open = &g_array_index(reader->open, struct open, reader->open->len - 1);

	reader->ends[open->line] = MAX(reader->ends[open->line], MAX(last, open->line));
	reader->first -= open->line == 0;
	g_array_set_size(reader->open, reader->open->len - 1);
}

/* A block that ends has around it the unfinished ones in it. */
static void end(struct reader *reader, const char *which)
{
	guint at;

	reader->depth -= reader->depth > 0;
	if (!reader->open)
		return;
	for (at = reader->open->len; at > 0; at--)
		if (strcmp(g_array_index(reader->open, struct open, at - 1).end, which) == 0)
			break;
	if (at == 0 && !reader->part)
		return;
	while (reader->open->len > at)
		pop(reader, reader->line - 1);
	if (at > 0)
		pop(reader, reader->line);
}

/* In a comment: goes behind it, or to the end of the line. */
static const char *read_comment(struct reader *reader, const char *at)
{
	struct fold_state *state = &reader->state;
	const char open = state->kind;

	while (!ends_line(at)) {
		if (*at == open && at[1] == '*') {
			state->depth += state->depth < 255;
			at += 2;
		} else if (*at == '*' && at[1] == (open == '(' ? ')' : '/')) {
			at += 2;
			if (--state->depth > 0)
				continue;
			state->kind = 0;
			if (reader->open)
				end(reader, "(");
			else
				reader->depth -= reader->depth > 0;
			break;
		} else {
			at++;
		}
	}
	return at;
}

static const char *read_text(const char *at)
{
	const char quote = *at++;

	while (!ends_line(at) && *at != quote)
		at += *at == '$' && !ends_line(at + 1) ? 2 : 1;
	return *at == quote ? at + 1 : at;
}

static const char *read_word(struct reader *reader, const char *start, bool part)
{
	const char *at = start, *block;

	while (in_name(*at) && !ends_line(at))
		at++;
	if (!part && *at != '#') {
		block = ended(start, (gsize)(at - start));
		if (block)
			end(reader, block);
		block = begun(start, (gsize)(at - start), reader->first_word);
		if (block)
			begin(reader, block);
	}
	while (*at == '#')
		at++;
	reader->first_word = false;
	return at;
}

static void read_line(struct reader *reader, const char *at)
{
	bool part = false; /* of a longer name, behind . or #                      */

	reader->depth = 0;
	reader->first_word = true;
	reader->slashes = reader->any = false;
	if (reader->state.kind)
		at = read_comment(reader, at);
	while (!ends_line(at)) {
		const char *start = at;

		if (*at == ' ' || *at == '\t') {
			at++;
			continue;
		}
		if (*at == '/' && at[1] == '/') {
			reader->slashes = !reader->any;
			return;
		}
		reader->any = true;
		if ((*at == '(' || *at == '/') && at[1] == '*') {
			reader->state = (struct fold_state){ *at, 1 };
			begin(reader, "(");
			at = read_comment(reader, at + 2);
		} else if (*at == '\'' || *at == '"') {
			at = read_text(at);
		} else if (in_name(*at)) {
			at = read_word(reader, at, part);
		} else {
			at++;
		}
		part = *start == '.' || (at > start && at[-1] == '#');
	}
}

enum fold_kind fold_kind_of(const char *line, struct fold_state *state)
{
	struct reader reader = { .state = *state };

	read_line(&reader, line);
	*state = reader.state;
	return reader.slashes ? FOLD_SLASHES : !reader.depth ? FOLD_NONE :
	       reader.depth == 1 && reader.state.kind ? FOLD_COMMENT : FOLD_BLOCK;
}

/* ---- texts ---- */

/* @first: stops when the blocks of line 0 have ended; true: they have. */
static bool read_lines(struct reader *reader, const char *text, bool first)
{
	int run = -1; /* where lines of // begin                               */

	for (reader->line = 0; text; reader->line++, text = fold_next(text)) {
		read_line(reader, text);
		if (!reader->slashes)
			run = -1;
		else if (run < 0)
			run = reader->line;
		else
			reader->ends[run] = reader->line;
		if (first && !reader->first && run != 0)
			return true;
	}
	while (reader->open->len)
		pop(reader, reader->line - 1);
	return false;
}

static int *read_ends(const char *text, struct fold_state state, bool first, int *count, bool *known)
{
	struct reader reader = { .state = state };

	reader.part = first;
	*count = 1;
	for (const char *at = fold_next(text); at; at = fold_next(at))
		++*count;
	reader.open = g_array_new(FALSE, FALSE, sizeof(struct open));
	reader.ends = g_new(int, *count);
	for (int i = 0; i < *count; i++)
		reader.ends[i] = i;
	*known = read_lines(&reader, text, first);
	g_array_unref(reader.open);
	return reader.ends;
}

int fold_end(const char *text, struct fold_state state, bool *known)
{
	int count, *ends = read_ends(text, state, true, &count, known);
	const int last = ends[0];

	g_free(ends);
	return last;
}

int *fold_ends(const char *text, int *count)
{
	bool known;

	return read_ends(text, (struct fold_state){ 0 }, false, count, &known);
}

/* Behind it a formatted line ends. */
static bool ends_head(const char *word, gsize len)
{
	static const char *const heads[] = { "THEN", "DO", "OF", "REPEAT", "STRUCT", NULL };

	for (int i = 0; heads[i]; i++)
		if (strlen(heads[i]) == len && ascii_same(heads[i], word, len))
			return true;
	return len >= 3 && ascii_same(word, "VAR", 3);
}

char *fold_key(const char *line)
{
	GString *key = g_string_new(NULL);

	while (!ends_line(line) && !(key->len && *line == '/' && line[1] == '/')) {
		const char *start = line;

		while (in_name(*line) && !ends_line(line))
			g_string_append_c(key, ascii_upper(*line++));
		if (ends_head(start, (gsize)(line - start)))
			break;
		if (line > start)
			continue;
		if (*line != ' ' && *line != '\t')
			g_string_append_c(key, *line);
		line++;
	}
	return g_string_free(key, FALSE);
}
