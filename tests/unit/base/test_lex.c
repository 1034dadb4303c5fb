/* SPDX-License-Identifier: MIT
 *
 * test_lex - the tokens of valid text, and that reading any other text ends.
 */
#include "engine/base/lex.h"
#include "tests/tap.h"

#include <stdint.h>

/* Tokens as "kind:text kind:text …", N for a name and so on. */
static const char *scan(const char *text, size_t len, bool newlines,
			bool comments)
{
	static const char letter[] = "$/NLASCY!";
	static char out[2000];
	struct lex lex;
	size_t used = 0;

	lex_init(&lex, text, len);
	lex.newlines = newlines;
	lex.comments = comments;
	out[0] = '\0';
	while (lex_next(&lex) != TOKEN_END && used < sizeof(out) - 200) {
		const struct token *token = &lex.token;
		bool line = token->kind == TOKEN_NEWLINE;

		used += (size_t)snprintf(out + used, sizeof(out) - used,
					 "%s%c:%.*s", used ? " " : "",
					 letter[token->kind],
					 line ? 0 : (int)token->len,
					 token->text);
	}
	return out;
}

static const char *tokens(const char *text)
{
	return scan(text, strlen(text), false, false);
}

static void names(void)
{
	CHECK_TEXT(tokens("Motor _a A1"), "N:Motor N:_a N:A1");
	CHECK_TEXT(tokens("Runout.Q Main.Motor.X"), "N:Runout.Q N:Main.Motor.X");
	CHECK_TEXT(tokens("a. b .c V0.3"), "N:a Y:. N:b Y:. N:c N:V0.3");
	CHECK_TEXT(tokens("a..b"), "N:a Y:. Y:. N:b");
	CHECK_TEXT(tokens("T\xc3\xbcr \xe9\x96\x80"),
		   "N:T\xc3\xbcr N:\xe9\x96\x80");
	CHECK_TEXT(tokens("a.\xc3\xbc"), "N:a.\xc3\xbc");
	CHECK_TEXT(tokens("a\xff" "b"), "N:a !:\xff N:b");
	CHECK_TEXT(tokens("a\xc2\x9b"), "N:a !:\xc2\x9b");
	CHECK_TEXT(tokens("a.\xff"), "N:a Y:. !:\xff");
}

static void numbers(void)
{
	CHECK_TEXT(tokens("12 1_0 16#FF 2#1010_0001"),
		   "L:12 L:1_0 L:16#FF L:2#1010_0001");
	CHECK_TEXT(tokens("T#1h2m TIME#1.5s T#-5ms INT#16#7F"),
		   "L:T#1h2m L:TIME#1.5s L:T#-5ms L:INT#16#7F");
	CHECK_TEXT(tokens("1.5E-3 1e+2 2.5s 10ms REAL#1.5E-3"),
		   "L:1.5E-3 L:1e+2 L:2.5s L:10ms L:REAL#1.5E-3");
	CHECK_TEXT(tokens("1-2 1E-x 16#1E-3 1.x"),
		   "L:1 Y:- L:2 L:1E Y:- N:x L:16#1E Y:- L:3 L:1 Y:. N:x");
	CHECK_TEXT(tokens("-5 0..7"), "Y:- L:5 L:0 Y:. Y:. L:7");
	CHECK_TEXT(tokens("1. 1"), "L:1 Y:. L:1");
	CHECK_TEXT(tokens("# T# 16#"), "Y:# L:T# L:16#");
}

static void symbols(void)
{
	CHECK_TEXT(tokens(":= => <= >= <> ** : = < > * ^|"),
		   "Y::= Y:=> Y:<= Y:>= Y:<> Y:** Y:: Y:= Y:< Y:> Y:* Y:^ Y:|");
	CHECK_TEXT(tokens("%IX0.3 %Q0..7 %TM0.V %MW4) % 5 %"),
		   "A:%IX0.3 A:%Q0 Y:. Y:. L:7 A:%TM0.V A:%MW4 Y:) Y:% L:5 Y:%");
	CHECK_TEXT(tokens("\"a b\" \"x$\"y$$\" \"\""),
		   "S:\"a b\" S:\"x$\"y$$\" S:\"\"");
	CHECK_TEXT(tokens("\"open\nx"), "!:\"open N:x");
	CHECK_TEXT(tokens("\"open\r\nx"), "!:\"open N:x");
	CHECK_TEXT(tokens("\"open$\nx"), "!:\"open$ N:x");
	CHECK_TEXT(tokens("\"open$"), "!:\"open$");
	CHECK_TEXT(tokens("\""), "!:\"");
	CHECK_TEXT(tokens("a\001b\x7f"), "N:a !:\001 N:b !:\x7f");
	CHECK_TEXT(scan("a\0b", 3, false, false), "N:a !: N:b");
}

static void comments(void)
{
	static const char text[] = "a (* x (* y *) z *) b // c\r\nd(* e";

	CHECK_TEXT(tokens(text), "N:a N:b N:d !:(* e");
	CHECK_TEXT(scan(text, strlen(text), true, true),
		   "N:a C:(* x (* y *) z *) N:b C:// c /: N:d !:(* e");
	CHECK_TEXT(tokens("(*) *)"), "");
	CHECK_TEXT(tokens("(*"), "!:(*");
	CHECK_TEXT(tokens("(* *"), "!:(* *");
	CHECK_TEXT(tokens("( * / /"), "Y:( Y:* Y:/ Y:/");
	CHECK_TEXT(tokens("//"), "");
	CHECK_TEXT(scan("\n\n a\n", 5, true, false), "/: /: N:a /:");
}

static void places(void)
{
	static const char text[] = "\xef\xbb\xbf" "a b\n(* 1\n2 *) c\n\n  \"d\" e";
	struct lex lex;

	lex_init(&lex, text, sizeof(text) - 1);
	lex_next(&lex);
	CHECK(lex.token.line == 1 && lex.token.column == 1);
	CHECK(!lex.token.space_before);
	lex_next(&lex);
	CHECK(lex.token.line == 1 && lex.token.column == 3);
	CHECK(lex.token.space_before);
	lex_next(&lex);
	CHECK(lex_is(&lex, "C"));
	CHECK(lex.token.line == 3 && lex.token.column == 6);
	CHECK(lex.token.space_before);
	lex_next(&lex);
	CHECK(lex.token.line == 5 && lex.token.column == 3);
	CHECK(!lex_is(&lex, "\"d\""));
	lex_next(&lex);
	CHECK(lex_next(&lex) == TOKEN_END);
	CHECK(lex_next(&lex) == TOKEN_END);
	CHECK(lex.token.len == 0);
}

static void words(void)
{
	static const char text[] = "Begin x := 1\nnext line\n\nlast";
	struct lex lex;

	lex_init(&lex, text, sizeof(text) - 1);
	CHECK(!lex_is(&lex, "begin"));
	lex_next(&lex);
	CHECK(lex_is(&lex, "BEGIN"));
	CHECK(!lex_is(&lex, "BEGI"));
	CHECK(!lex_is(&lex, "BEGINS"));
	CHECK(!lex_accept(&lex, "END"));
	CHECK(lex_accept(&lex, "BEGIN"));
	CHECK(lex_accept(&lex, "X"));
	CHECK(!lex_accept(&lex, ":"));
	CHECK(lex_accept(&lex, ":="));
	lex_skip_line(&lex);
	CHECK(lex_is(&lex, "next"));
	CHECK(lex.token.line == 2 && lex.token.column == 1);
	lex_skip_line(&lex);
	CHECK(lex_is(&lex, "last"));
	CHECK(lex.token.line == 4);
	lex_skip_line(&lex);
	CHECK(lex.token.kind == TOKEN_END);
	lex_skip_line(&lex);
	CHECK(lex.token.kind == TOKEN_END);

	lex_init(&lex, "a\nb\nc", 5);
	lex.newlines = true;
	lex_next(&lex);
	lex_next(&lex);
	CHECK(lex.token.kind == TOKEN_NEWLINE && lex.token.line == 1);
	lex_skip_line(&lex);
	CHECK_AS(lex_is(&lex, "b"),
		 "lex_skip_line() on a newline token goes to the next line");
	lex_skip_line(&lex);
	CHECK(lex_is(&lex, "c"));
}

static void utf8(void)
{
	static const char *const bad[] = {
		"\x80", "\xc0\x80", "\xc1\xbf", "\xe0\x80\x80", "\xe0\x9f\xbf",
		"\xed\xa0\x80", "\xf0\x80\x80\x80", "\xf4\x90\x80\x80",
		"\xf5\x80\x80\x80", "\xc3", "\xe9\x96", "\xf0\x9f\x94",
		"\xc3(", "\xe9\x96(", "\xff",
	};
	size_t at = 99;

	CHECK(utf8_valid("", 0, &at));
	CHECK(utf8_valid("a\x7f\xc3\xbc\xe9\x96\x80\xf0\x9f\x94\xa7", 11, &at));
	CHECK(at == 99);
	CHECK(!utf8_valid("ab\0c", 4, &at) && at == 2);
	CHECK(!utf8_valid("ab\xffg", 4, NULL));
	for (size_t i = 0; i < sizeof(bad) / sizeof(*bad); i++) {
		char text[8] = "x";

		memcpy(text + 1, bad[i], strlen(bad[i]));
		CHECK_AS(!utf8_valid(text, strlen(text), &at) && at == 1,
			 "invalid UTF-8");
		CHECK(utf8_length(bad[i], strlen(bad[i])) == 0);
	}
	CHECK(utf8_is_letter("\u00e9", 2) && utf8_is_letter("\u00aa", 2) &&
	      utf8_is_letter("\u0301", 2) && utf8_is_letter("\u6e29", 3) &&
	      utf8_is_letter("\u0663", 2) && utf8_is_letter("\U00020000", 4));
	CHECK(!utf8_is_letter("\u00a0", 2) && !utf8_is_letter("\u00b2", 2) &&
	      !utf8_is_letter("\u00d7", 2) && !utf8_is_letter("\u200b", 3) &&
	      !utf8_is_letter("\u3000", 3) && !utf8_is_letter("\u2014", 3) &&
	      !utf8_is_letter("\u201c", 3) && !utf8_is_letter("\u2192", 3) &&
	      !utf8_is_letter("\U0001f600", 4) && !utf8_is_letter("\ue000", 3));
	CHECK(utf8_code("\u6e29", 3) == 0x6e29 && utf8_code("\U0001f600", 4) == 0x1f600);
	CHECK(utf16_text("\xff\xfeR\0", 4) && utf16_text("\xfe\xff\0R", 4));
	CHECK(utf16_text("R\0U\0", 4) && utf16_text("\0R\0U", 4));
	CHECK(!utf16_text("RUNG", 4) && !utf16_text("\0\0\0\0", 4) &&
	      !utf16_text("\xef\xbb\xbfR", 4) && !utf16_text("R\0", 2));
	CHECK(utf8_length("", 0) == 0);
	CHECK(utf8_length("\xf0\x9f\x94\xa7x", 5) == 4);
	CHECK(utf8_width("abc", 3) == 3);
	CHECK(utf8_width("T\xc3\xbcr", 4) == 3);
	CHECK(utf8_width("\xe9\x96\x80", 3) == 2);
	CHECK(utf8_width("u\xcc\x88", 3) == 1);
	CHECK(utf8_width("\xf0\x9f\x94\xa7", 4) == 2);
	CHECK(utf8_width("", 0) == 0);
	CHECK(utf8_width("a\xff", 2) == 2);
}

/* Whether all tokens lie in the text, one after another, and the last is TOKEN_END. */
static bool ends(const char *text, size_t len, bool all)
{
	struct lex lex;
	const char *at = text;
	size_t count = 0;

	lex_init(&lex, text, len);
	lex.newlines = lex.comments = all;
	while (lex_next(&lex) != TOKEN_END) {
		const struct token *token = &lex.token;

		if (token->text < at || token->len == 0 ||
		    token->text + token->len > text + len || ++count > len ||
		    token->line < 1 || token->column < 1)
			return false;
		at = token->text + token->len;
	}
	return true;
}

static void hostile(void)
{
	static char text[1 << 20];
	static const char pieces[] = "(**)\"$\n./%#:=<>aT19_E+-\xc3\xbc\xff\r ";
	uint32_t seed = 7;
	bool good = true;

	for (int c = 0; c < 256; c++) {
		memset(text, c, 4096);
		good &= ends(text, 4096, c & 1);
	}
	CHECK(good);
	memset(text, '(', sizeof(text));
	CHECK_AS(ends(text, sizeof(text), true), "1 MB of opening parentheses ends with TOKEN_END");
	for (size_t i = 0; i < sizeof(text); i++)
		text[i] = i & 1 ? '*' : '(';
	CHECK_AS(ends(text, sizeof(text), true),
		 "1 MB of nested comments ends with TOKEN_END");
	for (int round = 0; round < 300; round++) {
		size_t len = (size_t)(round % 97);

		for (size_t i = 0; i < len; i++) {
			seed = seed * 1664525u + 1013904223u;
			text[i] = pieces[(seed >> 16) % (sizeof(pieces) - 1)];
		}
		good &= ends(text, len, round & 1);
	}
	CHECK_AS(good, "random text ends with TOKEN_END");
}

int main(void)
{
	names();
	numbers();
	symbols();
	comments();
	places();
	words();
	utf8();
	hostile();
	return tap_done();
}
