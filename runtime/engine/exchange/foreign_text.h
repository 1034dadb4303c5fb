/* SPDX-License-Identifier: MIT
 *
 * foreign_text - the text of a rung file while an importer writes it.
 *
 * Each line remembers its place in the foreign file; names are new and can be declared. It
 * knows no format: the importers of LDmicro and others use it.
 */
#ifndef EXCHANGE_FOREIGN_TEXT_H
#define EXCHANGE_FOREIGN_TEXT_H

#include "engine/base/names.h"
#include "engine/exchange/report.h"

#include <stdarg.h>

struct foreign_place {
	const char *member;      /* a file of a folder; "": the file itself        */
	int line;                /* 1-based; 0: none                               */
};

struct foreign_text {
	char *text;              /* NUL-ended; NULL: nothing was written           */
	size_t len;
	struct foreign_place *place; /* of each line, from line 1 on               */
	int lines;
};

/* What a text is written with. */
struct writing {
	struct arena *arena;
	struct foreign_text out;
	size_t room;
	struct foreign_place at; /* of the lines and reports that follow          */
	struct classic_report *report;
	const char *pou;         /* for the report; NULL: none                     */
	int rung;                /* 1-based in @pou; 0: none                       */
	struct names taken;      /* names given so far                             */
	int *tried, tried_count; /* by name: the number that was put behind it last */
};

/** writing_init - nothing written. Owns: @arena owns all that it makes. */
void writing_init(struct writing *w, struct arena *arena, struct classic_report *report);
/** w_put - appends formatted text. Fails: without memory the arena remembers it. */
void w_put(struct writing *w, const char *format, ...) __attribute__((format(printf, 2, 3)));
/** w_add - appends another text with the places of its lines. */
void w_add(struct writing *w, const struct foreign_text *text);
/** w_text - formatted text in the arena; "" without memory. */
const char *w_text(struct writing *w, const char *format, ...)
	__attribute__((format(printf, 2, 3)));
/** w_tell - a line of the report, with the place and rung in work. */
void w_tell(struct writing *w, enum report_kind kind, const char *format, ...)
	__attribute__((format(printf, 3, 4)));
/** w_name - @wish, or with a suffix if it is taken, reserved or no name. */
const char *w_name(struct writing *w, const char *wish);
/** w_comment - @text as a comment on lines of its own; it may hold marks of comments. */
void w_comment(struct writing *w, const char *indent, const char *text);
/** w_clean - @text without marks of comments and control characters, for inside a comment. */
const char *w_clean(struct writing *w, const char *text);
/** w_string - @text as a literal in single quotes, at most @most bytes of it. */
const char *w_string(struct writing *w, const char *text, size_t most);
/** foreign_print - formatted text in @arena. Fails: NULL: no memory. */
char *foreign_print(struct arena *arena, const char *format, va_list args) __attribute__((format(printf, 2, 0)));
/** foreign_name - letters, digits and _ of @wish, at most @most bytes of it; any other character becomes _. */
const char *foreign_name(struct arena *arena, const char *wish, size_t most);
/** foreign_utf8 - @len bytes as UTF-8: what is none is read as Latin-1. NULL: no memory. */
const char *foreign_utf8(struct arena *arena, const char *text, size_t len);
#endif
