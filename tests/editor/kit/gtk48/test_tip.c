/* SPDX-License-Identifier: MIT
 *
 * test_tip - tooltips: as many characters as columns, and lines of bounded width.
 */
#include "editor-gtk/kit/gtk48/tip.h"
#include "tests/tap.h"

#include <string.h>

#define LINE 60

static int columns(const char *text, const char *end)
{
	int count = 0;

	for (; text < end; text = g_utf8_next_char(text)) {
		const gunichar c = g_utf8_get_char(text);

		count += g_unichar_iszerowidth(c) ? 0 : g_unichar_iswide(c) ? 2 : 1;
	}
	return count;
}

static void one_line(void)
{
	static const char *const texts[] = { "Main", "\xe4\xb8\xbb\xe7\xa8\x8b\xe5\xba\x8f",
		"\xe7\x94\xb5\xe6\x9c\xba: the motor", "" };

	for (int i = 0; i < 4; i++) {
		char *tip = tip_text(texts[i]);
		const int wide = columns(texts[i], texts[i] + strlen(texts[i]));

		CHECK(g_str_has_prefix(tip, texts[i]));
		CHECK(g_utf8_strlen(tip, -1) == wide);
		CHECK(columns(tip, tip + strlen(tip)) == wide);
		g_free(tip);
	}
}

/* Without the added line breaks and joiners the tooltip is @text. */
static void many_lines(const char *text, int least)
{
	char *tip = tip_text(text);
	char **lines = g_strsplit(tip, "\n", -1);
	GString *all = g_string_new(NULL), *plain = g_string_new(NULL);
	int most = 0, count = 0;

	for (; lines[count]; count++) {
		most = MAX(most, columns(lines[count], lines[count] + strlen(lines[count])));
		g_string_append(all, lines[count]);
	}
	for (const char *at = text; *at; at++)
		if (*at != '\n')
			g_string_append_c(plain, *at);
	g_string_replace(plain, " ", "", 0);
	g_string_replace(all, " ", "", 0);
	CHECK(most <= LINE);
	CHECK(count >= least);
	CHECK_TEXT(all->str, plain->str);
	g_string_free(all, TRUE);
	g_string_free(plain, TRUE);
	g_strfreev(lines);
	g_free(tip);
}

/* Lines end between words: with blanks for the line breaks the words are those of @text. */
static void whole_words(const char *text)
{
	char *tip = tip_text(text), *one_line = g_strdelimit(g_strdup(text), "\n", ' ');

	CHECK_TEXT(g_strchomp(g_strdelimit(tip, "\n", ' ')), g_strchomp(one_line));
	g_free(one_line);
	g_free(tip);
}

int main(void)
{
	GString *latin = g_string_new("Start\n"), *wide = g_string_new(NULL);
	GString *word = g_string_new(NULL);

	for (int i = 0; i < 50; i++) {
		g_string_append(latin, "what runs until it is stopped ");
		g_string_append(wide, "\xe7\x94\xb5\xe6\x9c\xba\xef\xbc\x8c");
		g_string_append(word, "Donaudampf");
	}
	one_line();
	many_lines("one\ntwo\n", 2);
	many_lines("one\n\nthree", 3);
	many_lines(latin->str, 25);
	whole_words(latin->str);
	many_lines(wide->str, 5);
	many_lines(word->str, 9);
	g_string_free(latin, TRUE);
	g_string_free(wide, TRUE);
	g_string_free(word, TRUE);
	return tap_done();
}
