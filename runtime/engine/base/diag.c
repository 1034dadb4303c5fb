/* SPDX-License-Identifier: MIT
 *
 * diag - what is wrong with a program text, as data with a place.
 *
 * Texts and codes are rows of diag.def. Control characters and broken UTF-8 of a
 * hostile file are replaced. It prints nothing itself.
 */
#include "engine/base/diag.h"
#include "engine/base/lex.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

/* Code and text of each row, one after another. One string needs no relocation; a
 * pointer a row would. A search is cheap enough, as it happens only when a message is
 * printed. */
static const char texts[] =
#define DIAG(id, code, severity, text) DIAG_TEXT(code "\0" text) "\0"
#include "engine/diag.def"
;

/* All others are errors. */
static const uint16_t warnings[] = {
#define OF_SEVERITY_ERROR(id)
#define OF_SEVERITY_WARNING(id) DIAG_##id,
#define DIAG(id, code, severity, text) OF_##severity(id)
#include "engine/diag.def"
};

void diag_init(struct diag_list *list)
{
	list->count = list->dropped = list->errors = 0;
}

/* C0, DEL and C1: a terminal might act on them. DIAG_AND is one of them. */
static bool is_control(const char *at, size_t len)
{
	unsigned char c = (unsigned char)at[0];

	return (c < 0x20 && c != DIAG_AND[0]) || c == 0x7f ||
	       (c == 0xc2 && len > 1 && (unsigned char)at[1] < 0xa0);
}

/* Whole characters of @text, up to LIMIT_PARTS bytes; of a single part LIMIT_ARG. */
static void copy_clean(char *out, const char *text)
{
	const size_t most = strchr(text, DIAG_AND[0]) ? LIMIT_PARTS : LIMIT_ARG;
	size_t left = strlen(text), used = 0;

	while (left) {
		size_t len = utf8_length(text, left);
		bool shown = len && !is_control(text, len);

		if (used + (shown ? len : 1) >= most)
			break;
		if (shown)
			memcpy(out + used, text, len);
		else
			out[used] = '?';
		used += shown ? len : 1;
		text += len ? len : 1;
		left -= len ? len : 1;
	}
	out[used] = '\0';
}

/* Makes room for an error in a full list: drops the last warning. */
static bool drop_warning(struct diag_list *list)
{
	int at = list->count - 1;

	while (at >= 0 &&
	       diag_severity(list->diag[at].id) != SEVERITY_WARNING)
		at--;
	if (at < 0)
		return false;
	list->count--;
	memmove(&list->diag[at], &list->diag[at + 1],
		(size_t)(list->count - at) * sizeof(list->diag[0]));
	return true;
}

bool diag_add(struct diag_list *list, struct diag place, const char *arg, ...)
{
	bool error = diag_severity(place.id) == SEVERITY_ERROR;
	char text[LIMIT_PARTS + 4]; /* room to end the last whole character    */
	struct diag *added;
	va_list args;

	list->errors += error;
	if (list->count == LIMIT_DIAGS) {
		list->dropped++;
		if (!error || !drop_warning(list))
			return !error;
	}
	va_start(args, arg);
	if (vsnprintf(text, sizeof(text), arg, args) < 0)
		text[0] = '\0';
	va_end(args);
	added = &list->diag[list->count++];
	*added = place;
	copy_clean(added->arg, text);
	return !error;
}

int diag_name_length(const struct diag *diag)
{
	return (int)strcspn(diag->arg, DIAG_AND);
}

/* The code of a row; its text is behind it. */
static const char *row_of(enum diag_id id)
{
	const char *at = texts;

	for (int i = 0; i < 2 * (int)id; i++)
		at += strlen(at) + 1;
	return at;
}

const char *diag_code(enum diag_id id)
{
	return id < DIAG_COUNT ? row_of(id) : "LD000";
}

enum diag_severity diag_severity(enum diag_id id)
{
	for (size_t i = 0; i < sizeof(warnings) / sizeof(*warnings); i++)
		if (warnings[i] == id)
			return SEVERITY_WARNING;
	return SEVERITY_ERROR;
}

const char *diag_text(enum diag_id id)
{
	const char *code = diag_code(id);

	return id < DIAG_COUNT ? code + strlen(code) + 1 : "";
}

struct out {
	char *text;
	size_t size, len;
};

static void put(struct out *out, const char *format, ...)
	__attribute__((format(printf, 2, 3)));

static void put(struct out *out, const char *format, ...)
{
	bool room = out->len < out->size;
	va_list args;
	int len;

	va_start(args, format);
	len = vsnprintf(room ? out->text + out->len : NULL,
			room ? out->size - out->len : 0, format, args);
	va_end(args);
	if (len > 0)
		out->len += (size_t)len;
}

/* Part @n of an argument, from 1 on; empty if there is none. */
static const char *part_of(const char *arg, int n, int *len)
{
	while (--n > 0) {
		arg += strcspn(arg, DIAG_AND);
		arg += *arg != '\0';
	}
	*len = (int)strcspn(arg, DIAG_AND);
	return arg;
}

/* The number after %, 1 to 9; 0: @text does not begin with a place. */
static int place_at(const char *text)
{
	return text[0] == '%' && text[1] >= '1' && text[1] <= '9' ? text[1] - '0' : 0;
}

/* Whether all parts that the group {…} at @text names are there. */
static bool is_whole(const char *text, const char *arg)
{
	int len = 1;

	for (; *text && *text != '}' && len > 0; text++)
		if (place_at(text))
			part_of(arg, place_at(text), &len);
	return len > 0;
}

static void put_filled(struct out *to, const char *text, const char *arg)
{
	const size_t from = to->len;
	unsigned int placed = 0;
	const char *part;
	int len;

	for (const char *at = text; *at; at++)
		if (place_at(at))
			placed |= 1u << place_at(at);
	for (; *text; text++) {
		if (*text == '{' && !is_whole(text, arg))
			text += strcspn(text, "}");
		else if (place_at(text)) {
			part = part_of(arg, place_at(text), &len);
			put(to, "%.*s", len, part);
			text++;
		} else if (*text != '{' && *text != '}') {
			put(to, "%c", *text);
		}
		if (!*text)
			break;
	}
	for (int n = 1; n <= DIAG_PARTS; n++) {
		part = part_of(arg, n, &len);
		if (len > 0 && !(placed & 1u << n))
			put(to, "%s%.*s", to->len > from ? ": " : "", len, part);
	}
}

int diag_fill(const char *text, const char *arg, char *out, size_t size)
{
	struct out to = { out, size, 0 };

	if (size)
		out[0] = '\0';
	put_filled(&to, text, arg);
	return (int)to.len;
}

int diag_print(const struct diag *diag, char *out, size_t size)
{
	struct out to = { out, size, 0 };
	bool error = diag_severity(diag->id) == SEVERITY_ERROR;

	if (size)
		out[0] = '\0';
	if (diag->file)
		put(&to, "%s:", diag->file);
	if (diag->file && diag->line > 0)
		put(&to, "%d:", diag->line);
	if (diag->file && diag->line > 0 && diag->column > 0)
		put(&to, "%d:", diag->column);
	if (diag->file)
		put(&to, " ");
	/* With a line the POU is redundant. An unsaved rung has no line. */
	if (diag->line <= 0 && diag->pou)
		put(&to, "%s: ", diag->pou);
	if (diag->rung > 0 && diag->row > 0)
		put(&to, "rung %d (%d,%d): ", diag->rung, diag->row, diag->col);
	else if (diag->rung > 0)
		put(&to, "rung %d: ", diag->rung);
	put(&to, "%s %s: ", error ? "error" : "warning", diag_code(diag->id));
	put_filled(&to, diag_text(diag->id), diag->arg);
	return (int)to.len;
}
