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

#include <stdbool.h>
#include <stddef.h>

enum io_field {
	IO_ADDRESS, IO_DRIVER,
	IO_LINE,       /* "GPIO17", or label and offset: "1c20800.pinctrl 7"   */
	IO_PULL, IO_ACTIVE_LOW, /* "1" or ""                                   */
	IO_DEBOUNCE, IO_DRIVE, IO_SAFE,
	IO_COMMENT,    /* behind # or //, without blanks around it             */
	IO_FIELDS
};

struct io_span { size_t at, len; }; /* bytes of the text; len 0: missing           */

/* Words of a line that mean something. */
enum io_word {
	IO_WORD_ADDRESS, IO_WORD_DRIVER, IO_WORD_LINE, IO_WORD_CHIP, IO_WORD_OFFSET,
	IO_WORD_PULL, IO_WORD_ACTIVE_LOW, IO_WORD_DEBOUNCE, IO_WORD_DRIVE, IO_WORD_SAFE,
	IO_WORDS
};

struct io_row {
	int line;                      /* 1-based, the line of the address      */
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
/** io_text_add - a line "ADDRESS  DRIVER" behind that of @row; -1: at the end. Outputs get
 * safe=0. */
enum io_refusal io_text_add(const struct io_text *io, int row, const char *address,
			    const char *driver, const char *comment,
			    struct io_edit *edit);
/** io_text_choices - the possible words of a field; NULL: any. NULL-ended, lives for ever. */
const char *const *io_text_choices(enum io_field field);

#endif
