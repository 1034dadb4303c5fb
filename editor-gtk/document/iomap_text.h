/* SPDX-License-Identifier: MIT
 *
 * iomap_text - the text of an I/O map as rows and fields, for a table that edits it.
 *
 * The text is the model: an edit replaces some bytes, and everything else stays as it was
 * typed, even what cannot be read. It finds the same words as hal/iomap.c and judges none
 * of them. No toolkit, no files.
 */
#ifndef EDITOR_IOMAP_TEXT_H
#define EDITOR_IOMAP_TEXT_H

#include "engine/base/iec.h"

#include <stdbool.h>
#include <stddef.h>

/* What a line is about. */
enum io_kind {
	IO_KIND_POINT,   /* and whatever is none of the others                 */
#define MAP_STATEMENT(id, read) IO_KIND_##id,
#include "hal/map_words.def"
	IO_KINDS
};

enum io_field {
	IO_ADDRESS,    /* of a point and of a WINDOW; else the name of the line    */
	IO_DRIVER,     /* of a BUS and a SERVE: its kind, "modbus-rtu"             */
	IO_LINE,       /* "GPIO17", or label and offset: "1c20800.pinctrl 7"   */
	IO_PULL, IO_ACTIVE_LOW, /* "1" or ""                                   */
	IO_DEBOUNCE, IO_DRIVE,
	IO_DEVICE,     /* device=, chip= of pwm, sensor=, from=                */
	IO_CHANNEL,    /* channel=, name=                                      */
	IO_PERIOD,
	IO_BUS,        /* of a WINDOW: the name of its SERVE                   */
	IO_UNIT, IO_TYPE,
	IO_TABLE,      /* "coil", "input-register" …                           */
	IO_NUMBER,     /* the first one in its table; of a WINDOW "0..9"       */
	IO_BIT, IO_AS, IO_RAW, IO_WORD_ORDER, IO_BYTE_ORDER,
	IO_RANGE,      /* "0..27648 at 0V..10V"                                */
	IO_LIMITS, IO_THRESHOLD, IO_HYSTERESIS, IO_FILTER, IO_POLL, IO_STALE, IO_SUBSTITUTE,
	IO_REFRESH, IO_ON_CHANGE, /* "1" or ""                                 */
	IO_ASK,        /* name of a block                                      */
	IO_OF,         /* of a quality: the inputs, "%AIW0..6"                 */
	IO_SAFE,
	IO_PORT, IO_BAUD, IO_PARITY, IO_STOP_BITS, IO_HOST, IO_INTERFACE, IO_GROUP, IO_TIMEOUT,
	IO_LISTEN, IO_CONNECTIONS, IO_RATE,
	IO_ACCESS,     /* "read-only", "read-write"                            */
	IO_NAMES,      /* "Level, Running"                                     */
	IO_EVERY,
	IO_DI, IO_DQ, IO_AI, IO_AQ, /* of a MODULE, and where they begin:      */
	IO_FIRST_DI, IO_FIRST_DQ, IO_FIRST_AI, IO_FIRST_AQ,
	IO_READ_REGISTERS, IO_WRITE_REGISTERS, IO_READ_COILS, IO_WRITE_COILS, IO_GAP, /* of a DEVICE */
	IO_TOGETHER,   /* "1" or ""                                            */
	IO_COMMENT,    /* behind # or //, without blanks around it             */
	IO_FIELDS
};

struct io_span { size_t at, len; }; /* bytes of the text; len 0: missing           */

/* Words of a line that mean something, in the usual order. */
enum io_word {
#define MAP_PART(id) IO_WORD_##id,
#define MAP_WORD(id, text, has_value) IO_WORD_##id,
#include "hal/map_words.def"
	IO_WORDS
};

struct io_row {
	enum io_kind kind;
	int line;                      /* 1-based, the line of its first word   */
	struct io_span word[IO_WORDS]; /* the first of each kind                */
	struct io_span comment;        /* with its # or //                      */
	size_t from;                   /* start of the line, or the end of the statement before
					  it in the same line */
	size_t words_end;              /* behind its last word                  */
	size_t end;                    /* of the line, before its newline       */
};

struct io_text {
	const char *text;
	size_t len;
	struct io_row *row;
	int count;
	int board_line;        /* line of BOARD, 1-based, if it is the first statement; 0: it
				  is not */
	struct io_span board;  /* the name of the board, with its quotes        */
};

/* Replaces bytes of the text. */
struct io_edit {
	size_t at, removed;
	char *with;            /* NUL-ended; free()                             */
};

enum io_refusal {
	IO_GOOD,
	IO_MANY_WORDS,  /* it must be one word                                  */
	IO_NO_WORD,     /* not one of the choices                               */
	IO_EMPTY,       /* an address and a driver are needed                   */
	IO_NO_BOARD,    /* the BOARD line has no name                           */
	IO_BAD_OFFSET,  /* a label without a number                             */
	IO_BAD_NAME,    /* control characters, or too long                      */
	IO_NO_FIELD,    /* this line has no such field                          */
	IO_SHARED_LINE, /* the line has more than this row                      */
	IO_MEMORY,
};

/** io_text_read - the rows of @text, which must outlive @out. Any bytes. Owns: the caller,
 * io_text_free().   Fails: false: no memory; call io_text_free() all the same. */
bool io_text_read(struct io_text *out, const char *text, size_t len);
void io_text_free(struct io_text *io);

/** io_text_field - the text of a cell; "" if the field is missing. Caller: free(). NULL: no
 * memory. */
char *io_text_field(const struct io_text *io, int row, enum io_field field);
/** io_field_name - title of a column, translated. */
const char *io_field_name(enum io_field field);
/** io_field_is_flag - it has no value: "1" or "". */
bool io_field_is_flag(enum io_field field);
/** io_text_board - the name of the board, without quotes. As io_text_field. */
char *io_text_board(const struct io_text *io);

/**
 * io_text_set - the edit that sets a field to @value; "" deletes the field
 *
 * Values are not judged, but one that would split the line into other words is refused.
 * Later words stay in their columns if there are enough blanks.
 * Fails: returns the reason; @edit is then empty.
 */
enum io_refusal io_text_set(const struct io_text *io, int row, enum io_field field,
			    const char *value, struct io_edit *edit);
enum io_refusal io_text_set_board(const struct io_text *io, const char *name,
				  struct io_edit *edit);
/** io_text_delete - the whole line of a row, its comment included. */
enum io_refusal io_text_delete(const struct io_text *io, int row, struct io_edit *edit);
#define IO_AT_END   (-1)
#define IO_AT_START (-2) /* before all rows                                    */
/** io_text_add - a line "FIRST  SECOND  WORDS" behind that of @row, or IO_AT_…. Outputs get
 * safe=0, unless @words says otherwise. @words: may be "". */
enum io_refusal io_text_add(const struct io_text *io, int row, const char *first,
			    const char *second, const char *words, const char *comment,
			    struct io_edit *edit);
/** io_text_move - the line of a row goes before or behind that of another. */
enum io_refusal io_text_move(const struct io_text *io, int row, int target, bool behind,
			     struct io_edit *edit);
/** io_text_choices - usual words of a field; NULL: any. NULL-ended, lives for ever. */
const char *const *io_text_choices(enum io_field field);
/** io_field_words - the words of the map that the field @field of lines of @kind stands for; IO_WORDS ends them, and
 * there is none of a comment. Lives for ever. */
const enum io_word *io_field_words(enum io_kind kind, enum io_field field);
/** io_word_find - the word of the option @text, "active-low" or "safe=0"; IO_WORDS: it is none. */
enum io_word io_word_find(const char *text, size_t len);
/** io_text_has - whether lines of this kind and driver have the field. */
bool io_text_has(const struct io_text *io, int row, enum io_field field);
/** io_kind_word - "BUS"; "" of a point. Lives for ever. */
const char *io_kind_word(enum io_kind kind);

/* The values of a line: an address, or several that follow one another. */
struct io_values {
	struct iec_addr first;
	uint32_t count;
};
/** io_values_read - of "%IW100..106". False: it is no address. */
bool io_values_read(const char *text, size_t len, struct io_values *out);
/** io_values_have - whether the values have a bit in common with @addr. */
bool io_values_have(const struct io_values *values, struct iec_addr addr);

#endif
