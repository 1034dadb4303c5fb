/* SPDX-License-Identifier: MIT
 *
 * spelling - addresses as a person reads and types them; see spelling.h.
 */
#include "editor-gtk/kit/spelling.h"

#include "editor-gtk/kit/settings.h"
#include "engine/model/dialect.h"

#include <glib.h>
#include <stdio.h>
#include <string.h>

enum { ADDRESS_TEXT = 32 };

enum spelling spelling_screen(void)
{
	return settings_enum("spelling", SPELLING_IEC) == SPELLING_SIEMENS ? SPELLING_SIEMENS :
									      SPELLING_IEC;
}

/* ---- one address ---- */

/* Without %, and without the X of a bit. */
static void make_short(const char *canonical, const char *letters, char *out)
{
	const size_t len = strlen(letters);
	const char *rest = canonical + 1 + len;

	snprintf(out, ADDRESS_TEXT, "%s%s", letters, *rest == 'X' ? rest + 1 : rest);
}

static bool is_same(struct iec_addr a, struct iec_addr b)
{
	return a.area == b.area && a.bits == b.bits && a.bit == b.bit && a.byte == b.byte;
}

/* Does it mean the same without a %, here and for the person who reads it? */
static bool reads_back(const char *text, struct iec_addr addr)
{
	struct dialect_special special;
	struct iec_addr read;

	return iec_addr_parse(text, strlen(text), &read) == ADDR_OK && is_same(read, addr) &&
	       !dialect_special(text, strlen(text), &special);
}

int spelling_address(enum spelling spelling, struct iec_addr addr, char *out, size_t size)
{
	char canonical[ADDRESS_TEXT], text[ADDRESS_TEXT];

	iec_addr_print(addr, canonical, sizeof(canonical));
	if (spelling == SPELLING_IEC || addr.area == AREA_NONE)
		return snprintf(out, size, "%s", canonical);
	make_short(canonical, iec_area_row(addr.area)->letters, text);
	return snprintf(out, size, "%s", reads_back(text, addr) ? text : canonical);
}

/* ---- a text ---- */

static bool is_word(char c)
{
	return g_ascii_isalnum(c) || c == '_' || c == '.' || (guchar)c >= 0x80;
}

/* I0.3, MW4: what a name has not (a point), or hardly. Q0 and M5 may be anything. */
static bool looks_so(const char *word, size_t len)
{
	size_t letters = 0;

	while (letters < len && g_ascii_isalpha(word[letters]))
		letters++;
	return letters > 1 || (letters == 1 && memchr(word, '.', len));
}

static bool is_name(const struct spelling_rule *rule, const char *word, size_t len)
{
	const char *point = memchr(word, '.', len);

	return rule->is_name && (rule->is_name(rule->context, word, len) ||
	       (point && rule->is_name(rule->context, word, (size_t)(point - word))));
}

static void put_word(GString *out, const struct spelling_rule *rule, const char *word, size_t len)
{
	const bool marked = *word == '%';
	struct dialect_special special;
	struct iec_addr addr;
	char text[ADDRESS_TEXT];

	if (iec_addr_parse(word, len, &addr) == ADDR_OK &&
	    (marked || (rule->is_name && rule->spelling == SPELLING_IEC && looks_so(word, len) &&
			!is_name(rule, word, len) && !dialect_special(word, len, &special)))) {
		spelling_address(rule->spelling, addr, text, sizeof(text));
		if (*text == '%' || !is_name(rule, text, strlen(text))) {
			g_string_append(out, text);
			return;
		}
	}
	g_string_append_len(out, word, (gssize)len);
}

/* The bytes of a text in quotes or of a comment that begins at @at; 0: none does. */
static size_t apart(const char *at)
{
	const bool comment = at[0] == '(' && at[1] == '*';
	const char mark[2] = { *at, 0 };
	const char *end;

	if (!comment && *at != '\'' && *at != '"')
		return 0;
	end = comment ? strstr(at + 2, "*)") : strstr(at + 1, mark);
	return end ? (size_t)(end - at) + (comment ? 2 : 1) : strlen(at);
}

char *spelling_text(const struct spelling_rule *rule, const char *text)
{
	GString *out = g_string_new(NULL);

	for (const char *at = text; *at;) {
		const size_t quoted = apart(at);
		size_t len = quoted ? quoted : *at == '%';

		while (!quoted && is_word(at[len]))
			len++;
		if (quoted || !len || (at > text && at[-1] == '#'))
			g_string_append_len(out, at, (gssize)MAX(len, 1));
		else
			put_word(out, rule, at, len);
		at += MAX(len, 1);
	}
	return g_string_free(out, FALSE);
}

char *spelling_shown(const char *text)
{
	return spelling_text(&(struct spelling_rule){ .spelling = spelling_screen() }, text);
}
