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
	IO_KIND_BUS, IO_KIND_SERVE, IO_KIND_WINDOW, IO_KIND_PUBLISH, IO_KIND_MODULE, IO_KIND_DEVICE,
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
	IO_WORD_STATEMENT, /* BUS, SERVE, WINDOW, PUBLISH, MODULE, DEVICE       */
	IO_WORD_ADDRESS,   /* or name                                          */
	IO_WORD_DRIVER, IO_WORD_LINE, IO_WORD_CHIP, IO_WORD_OFFSET,
	IO_WORD_PULL, IO_WORD_ACTIVE_LOW, IO_WORD_DEBOUNCE, IO_WORD_DRIVE,
	IO_WORD_DEVICE, IO_WORD_SENSOR, IO_WORD_FROM, IO_WORD_CHANNEL, IO_WORD_NAME,
	IO_WORD_PERIOD, IO_WORD_PORT, IO_WORD_BAUD, IO_WORD_PARITY, IO_WORD_STOP_BITS,
	IO_WORD_HOST, IO_WORD_LISTEN, IO_WORD_INTERFACE, IO_WORD_GROUP, IO_WORD_TIMEOUT,
	IO_WORD_NAMES, IO_WORD_EVERY, IO_WORD_BUS, IO_WORD_UNIT, IO_WORD_CONNECTIONS,
	IO_WORD_RATE, IO_WORD_READ_REGISTERS, IO_WORD_WRITE_REGISTERS, IO_WORD_READ_COILS,
	IO_WORD_WRITE_COILS, IO_WORD_GAP, IO_WORD_TOGETHER, IO_WORD_TYPE, IO_WORD_DI, IO_WORD_DQ, IO_WORD_AI, IO_WORD_AQ,
	IO_WORD_COIL, IO_WORD_DISCRETE_INPUT, IO_WORD_INPUT_REGISTER, IO_WORD_HOLDING_REGISTER,
	IO_WORD_SHOWN,     /* the address of a WINDOW                          */
	IO_WORD_ACCESS, IO_WORD_BIT, IO_WORD_AS, IO_WORD_RAW, IO_WORD_WORD_ORDER,
	IO_WORD_BYTE_ORDER, IO_WORD_RANGE,
	IO_WORD_AT, IO_WORD_AT_VALUE, /* behind range=: at 0V..10V             */
	IO_WORD_LIMITS, IO_WORD_THRESHOLD, IO_WORD_HYSTERESIS, IO_WORD_FILTER, IO_WORD_POLL,
	IO_WORD_STALE, IO_WORD_SUBSTITUTE, IO_WORD_REFRESH, IO_WORD_ON_CHANGE, IO_WORD_ASK, IO_WORD_SAFE,
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
