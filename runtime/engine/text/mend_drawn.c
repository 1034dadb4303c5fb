/* SPDX-License-Identifier: MIT
 *
 * mend_drawn - a row that was drawn with the characters of a picture; see mend_drawn.h.
 *
 * From left to right: dashes are passed, and each contact or coil becomes a cell.
 */
#include "engine/text/mend_drawn.h"
#include "engine/text/mend_number.h"

#include "engine/base/ascii.h"

#include <stdio.h>
#include <string.h>

#define COUNT(table) (sizeof(table) / sizeof((table)[0]))
#define MADE 200 /* longer than any row                                       */

struct drawing {
	const char *at; /* the cursor                                             */
	char made[MADE];
	size_t used;
	int cells, contacts, coils, nameless;
	size_t last;    /* where the word of the last cell begins                 */
};

/* The signs of both kinds; the first row is a contact or coil without any. */
static const struct sign { const char *drawn, *contact, *coil; } signs[] = {
	{ "", "NO", "COIL" }, { "/", "NC", "COILNOT" }, { "\\", "NC", "COILNOT" }, { "!", "NC", "COILNOT" },
	{ "NOT", "NC", "COILNOT" }, { "P", "P", "COILP" }, { "N", "N", "COILN" }, { "S", NULL, "S" }, { "R", NULL, "R" },
	{ "L", NULL, "S" }, { "U", NULL, "R" }, { "SET", NULL, "S" }, { "RESET", NULL, "R" }, { "NO", "NO", NULL },
	{ "NC", "NC", NULL }, { "XIC", "NO", NULL }, { "XIO", "NC", NULL }, { "COIL", NULL, "COIL" }, { "OTE", NULL, "COIL" },
};

static const char *past_blanks(const char *at)
{
	return at + strspn(at, " ");
}

/* The bytes of a name with its path, or of an address. */
static size_t name_length(const char *at)
{
	size_t len = *at == '%';

	while (mend_is_word(at[len]) || ((at[len] == '.' || at[len] == ':') && mend_is_word(at[len + 1])))
		len++;
	return len;
}

static const char *word_of(const struct sign *sign, bool coil)
{
	return coil ? sign->coil : sign->contact;
}

/* The sign that is all of @len bytes; NULL: none. */
static const struct sign *sign_of(const char *text, size_t len, bool coil)
{
	for (size_t i = 0; i < COUNT(signs); i++)
		if (word_of(&signs[i], coil) && ascii_is(signs[i].drawn, text, len))
			return &signs[i];
	return NULL;
}

/* The sign that @text begins with, before a name; the empty one if there is none. *@behind: the name. */
static const struct sign *sign_before(const char *text, bool coil, const char **behind)
{
	for (size_t i = COUNT(signs) - 1; i > 0; i--) {
		const size_t len = strlen(signs[i].drawn);

		if (!word_of(&signs[i], coil) || !ascii_same(text, signs[i].drawn, len) ||
		    (mend_is_word(signs[i].drawn[0]) && text[len] != ' '))
			continue;
		*behind = past_blanks(text + len);
		return &signs[i];
	}
	*behind = text;
	return &signs[0];
}

/* One more cell. Without a name it gets an address. */
static bool add_cell(struct drawing *d, const char *word, bool coil, const char *name, size_t len)
{
	char address[16];
	int written;

	if (!len) {
		snprintf(address, sizeof(address), "%%%cX0.%d", coil ? 'Q' : 'I', (coil ? d->coils : d->contacts) % 8);
		name = address;
		len = strlen(address);
		d->nameless++;
	}
	d->last = d->used + 2;
	written = snprintf(d->made + d->used, sizeof(d->made) - d->used, "| %s %.*s ", word, (int)len, name);
	if (written < 0 || (size_t)written >= sizeof(d->made) - d->used - 4)
		return false;
	d->used += (size_t)written;
	d->cells++;
	d->contacts += !coil;
	d->coils += coil;
	return true;
}

/* [ A > 5 ]: stays as it is. */
static bool add_expression(struct drawing *d, const char *text, size_t len)
{
	const int written = snprintf(d->made + d->used, sizeof(d->made) - d->used, "| [ %.*s ] ", (int)len, text);

	if (written < 0 || (size_t)written >= sizeof(d->made) - d->used - 4)
		return false;
	d->used += (size_t)written;
	d->cells++;
	d->contacts++;
	return true;
}

/* A sign alone has its name behind it: |/| Door, (S) Lamp. */
static bool take_behind(struct drawing *d, const struct sign *sign, bool coil)
{
	/* -(S)- Lamp: a line behind a coil, and its name behind that */
	const char *name = coil ? d->at + strspn(d->at, "- ") : past_blanks(d->at), *end;
	const size_t len = name_length(name);

	if (!add_cell(d, word_of(sign, coil), coil, name, len))
		return false;
	if (!len)
		return true;
	d->at = name + len;
	end = past_blanks(d->at);
	if (*end == '|' && end[1] && strchr("-(", end[1])) /* |/| Door |-- */
		d->at = end + 1;
	return true;
}

/* What stands between @open and @close, the brackets of an element. */
static bool take_element(struct drawing *d, char close)
{
	const char *from = past_blanks(d->at + 1), *end = strchr(d->at + 1, close), *name;
	const bool coil = close == ')';
	const struct sign *sign;
	size_t len;

	if (!end)
		return false;
	d->at = end + 1;
	while (end > from && end[-1] == ' ')
		end--;
	len = end > from ? (size_t)(end - from) : 0;
	if (close == ']' && len && strcspn(from, "<>=") < len)
		return add_expression(d, from, len);
	sign = sign_of(from, len, coil);
	if (sign)
		return take_behind(d, sign, coil);
	sign = sign_before(from, coil, &name);
	return name_length(name) && name + name_length(name) == end &&
	       add_cell(d, word_of(sign, coil), coil, name, name_length(name));
}

/* -- Start --: a name in the line. */
static bool take_name(struct drawing *d)
{
	const size_t len = name_length(d->at);

	if (!len || !add_cell(d, "NO", false, d->at, len))
		return false;
	d->at += len;
	return true;
}

static bool take_next(struct drawing *d)
{
	switch (*d->at) {
	case '-': case '+': case ' ':
		d->at++;
		return true;
	case '|':
		if (!*past_blanks(d->at + 1)) { /* the right rail */
			d->at++;
			return true;
		}
		return take_element(d, '|');
	case '[':
		return take_element(d, ']');
	case ']':
		return take_element(d, '[');
	case '(':
		return take_element(d, ')');
	default:
		return take_name(d);
	}
}

/* The last of several contacts in a drawing without a coil is the coil. */
static void make_coil(struct drawing *d)
{
	char name[MADE];

	if (d->coils || d->contacts < 2 || strncmp(d->made + d->last, "NO ", 3) != 0)
		return;
	snprintf(name, sizeof(name), "%s", d->made + d->last + 3);
	d->used = d->last + (size_t)snprintf(d->made + d->last, sizeof(d->made) - d->last, "COIL %s", name);
	d->coils++;
}

/* Does the row end with a +, where a branch joins the row above? */
static bool joins_above(const char *text)
{
	size_t len = strlen(text);

	while (len && strchr("- ", text[len - 1]))
		len--;
	return len && text[len - 1] == '+';
}

bool mend_is_drawn(const char *text)
{
	for (; *text && !(text[0] == '/' && text[1] == '/') && !(text[0] == '(' && text[1] == '*'); text++)
		if ((text[0] == '-' && text[1] && strchr("|[]()", text[1])) || (text[1] == '-' && strchr("|[])", text[0])))
			return true;
	return false;
}

/* | NO Start | …: who begins so knows the words; one cell may be drawn, and mend_habits.c mends that. */
static bool begins_with_word(const char *text)
{
	const char *behind;

	return *text == '|' && mend_is_word(sign_before(past_blanks(text + 1), false, &behind)->drawn[0]);
}

bool mend_drawn(char *text, size_t size, struct mended *out)
{
	struct drawing d = { .at = text };
	const size_t most = sizeof(out->from) - sizeof("…"), len = strlen(text);

	if (!mend_is_drawn(text) || strstr(text, "//") || strstr(text, "(*") || begins_with_word(text))
		return false;
	if (*d.at == '|' && past_blanks(d.at + 1)[0] && strchr("-+", past_blanks(d.at + 1)[0])) /* the left rail */
		d.at++;
	while (*d.at)
		if (!take_next(&d))
			return false;
	if (!d.cells)
		return false;
	if (!joins_above(text))
		make_coil(&d);
	snprintf(d.made + d.used, sizeof(d.made) - d.used, d.coils || !joins_above(text) ? "|" : "^|");
	if (d.used + 3 > size || strcmp(d.made, text) == 0)
		return false;
	*out = (struct mended){ .id = d.nameless ? DIAG_DRAWN_NAMELESS : DIAG_DRAWN, .column = 1 };
	snprintf(out->from, sizeof(out->from), "%.*s%s", (int)(len > most ? utf8_cut(text, most) : len), text,
		 len > most ? "…" : "");
	snprintf(text, size, "%s", d.made);
	return true;
}
