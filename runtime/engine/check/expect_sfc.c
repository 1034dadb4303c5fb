/* SPDX-License-Identifier: MIT
 *
 * expect_sfc - from a place in a chart to what is wanted there.
 *
 * It looks at the words before the cursor, and at the lines above for the item that they
 * stand in.
 */
#include "engine/check/expect_inside.h"

#include "engine/base/ascii.h"

#include <string.h>

enum inside { OUTSIDE, IN_STEP, IN_BODY };

/* Does the line at @at begin with this word? */
static bool begins(const char *text, size_t at, size_t end, const char *word)
{
	const size_t len = strlen(word);

	while (at < end && (text[at] == ' ' || text[at] == '\t'))
		at++;
	return end - at >= len && ascii_same(text + at, word, len) &&
	       (end - at == len || strchr(" \t(:;\r", text[at + len]));
}

static bool ends_with(const char *text, size_t at, size_t end, const char *word)
{
	const size_t len = strlen(word);

	while (end > at && strchr(" \t\r", text[end - 1]))
		end--;
	return end - at >= len && ascii_same(text + end - len, word, len);
}

/* What a line says of those below it; -1: nothing. */
static int inside_of(const char *text, size_t at, size_t end)
{
	static const struct {
		const char *word;
		enum inside in;
	} words[] = {
		{ "STEP", IN_STEP }, { "INITIAL_STEP", IN_STEP },
		{ "MACRO_STEP", IN_STEP }, { "TRANSITION", IN_BODY },
		{ "ACTION", IN_BODY }, { "END_STEP", OUTSIDE },
		{ "END_TRANSITION", OUTSIDE }, { "END_ACTION", OUTSIDE },
		{ "END_VAR", OUTSIDE }, { "PROGRAM", OUTSIDE }, { "CONTROL", OUTSIDE },
	};

	for (size_t i = 0; i < sizeof(words) / sizeof(*words); i++)
		if (begins(text, at, end, words[i].word))
			return ends_with(text, at, end, "END_TRANSITION") ||
			       ends_with(text, at, end, "END_STEP") ||
			       ends_with(text, at, end, "END_ACTION") ?
			       OUTSIDE : (int)words[i].in;
	return -1;
}

static enum inside inside_at(const char *text, size_t line)
{
	while (line > 0) {
		const size_t end = line - 1, at = expect_line(text, end);
		const int in = inside_of(text, at, end);

		if (in >= 0)
			return (enum inside)in;
		line = at;
	}
	return OUTSIDE;
}

static const struct expect_want nothing = { .block = WORD_COUNT };

/* ---- heads ---- */

static struct expect_want kinds_want(unsigned int kinds)
{
	return (struct expect_want){ .kinds = kinds, .block = WORD_COUNT };
}

/* The word before the last one, which is `:=`; NULL: it is not. */
static const struct token *setting(const struct before *b)
{
	return b->count >= 2 && expect_is(&b->token[b->count - 1], ":=") ?
	       &b->token[b->count - 2] : NULL;
}

static struct expect_want step_want(const struct before *b)
{
	const struct token *word = setting(b);

	if (word && expect_is(word, "ALARM"))
		return expect_write(CLASS_BOOL);
	return word ? expect_value(CLASS_TIME) : nothing;
}

/* Where the condition begins; 0: it does not yet. */
static int condition_at(const struct before *b)
{
	for (int i = 1; i < b->count; i++)
		if (expect_is(&b->token[i], ":=") &&
		    !expect_is(&b->token[i - 1], "PRIORITY"))
			return i + 1;
	return 0;
}

static struct expect_want transition_want(const struct before *b)
{
	const struct token *last = &b->token[b->count - 1];
	const int condition = condition_at(b);
	struct expect_want want = expect_value(0);
	bool named = false;

	want.kinds |= EXPECT_FUNCTION;
	want.boxes = true;
	if (condition)
		return b->count > condition && expect_ends_value(last) ? nothing : want;
	for (int i = 1; i < b->count; i++)
		named |= expect_is(&b->token[i], "FROM") || expect_is(&b->token[i], "TO");
	if (named && (expect_is(last, "FROM") || expect_is(last, "TO") ||
		      expect_is(last, "(") || expect_is(last, ",")))
		return kinds_want(EXPECT_STEP);
	return nothing;
}

static struct expect_want control_want(const struct before *b)
{
	const struct token *word = setting(b);

	if (!word)
		return nothing;
	return expect_value(expect_is(word, "FORCE") ? ANY_INT : CLASS_BOOL);
}

/* ---- lines ---- */

static struct expect_want use_want(const struct before *b)
{
	const struct token *last = b->count ? &b->token[b->count - 1] : NULL;
	struct expect_want want = expect_write(CLASS_BOOL);

	if (!last) {
		want.kinds |= EXPECT_ACTION | EXPECT_KEYWORD;
		return want;
	}
	if (expect_is(&b->token[0], "SET") || expect_is(&b->token[0], "RESET"))
		return b->count == 1 || expect_is(last, ",") ? want : nothing;
	if (expect_is(last, "("))
		return kinds_want(EXPECT_QUALIFIER);
	return expect_is(last, ",") ? expect_value(CLASS_TIME) : nothing;
}

static bool is_step(const struct token *token)
{
	return expect_is(token, "STEP") || expect_is(token, "INITIAL_STEP") ||
	       expect_is(token, "MACRO_STEP");
}

struct expect_want expect_sfc(struct before *b, const char *text, size_t line,
			      size_t bar, size_t to)
{
	enum inside in;

	if (bar > line) {
		expect_tokens(b, text, bar, to);
		return expect_cell(b);
	}
	expect_tokens(b, text, expect_statement(text, line), to);
	if (b->count && is_step(&b->token[0]))
		return step_want(b);
	if (b->count && expect_is(&b->token[0], "TRANSITION"))
		return transition_want(b);
	if (b->count && expect_is(&b->token[0], "CONTROL"))
		return control_want(b);
	in = inside_at(text, line);
	if (in == IN_STEP)
		return use_want(b);
	if (in == IN_BODY)
		return expect_list(b);
	return kinds_want(b->count ? 0 : EXPECT_KEYWORD);
}
