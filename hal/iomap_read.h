/* SPDX-License-Identifier: MIT
 *
 * iomap_read - what the two readers of an I/O map share: iomap.c reads lines of chips, iomap_channel.c
 * the others. Private to them.
 */
#ifndef HAL_IOMAP_READ_H
#define HAL_IOMAP_READ_H

#include "hal/channel.h"
#include "hal/drivers.h"

#include "engine/base/lex.h"

/* Bits of an area that have a line; it grows. */
struct taken { uint8_t *byte; uint32_t size; };

struct net_reader;

struct reader {
	struct lex lex;
	struct iomap map;
	struct arena *arena;
	struct diag_list *diags;
	int errors;
	struct taken taken[AREA_COUNT];
	struct net_reader *net;  /* of iomap_channel.c; NULL: nothing yet       */
};

/* Tokens without a blank between them: `chip=pinctrl-bcm2711` is one word. */
struct map_word {
	const char *text;
	size_t len;
	int line, column;
	bool bad;
};

/** next_word - the next word of the line; false: the line ends. */
bool next_word(struct reader *reader, struct map_word *out);
void skip_words(struct reader *reader);
/** complain - an error about @word, which is its first part. Returns false. */
bool complain(struct reader *reader, enum diag_id id, const struct map_word *word);
/** complain_about - the same with a second part. */
bool complain_about(struct reader *reader, enum diag_id id, const struct map_word *word, const char *second);
/** complain_form - LD505: the value of the option @word is bad; @form is how it is written. */
bool complain_form(struct reader *reader, const struct map_word *word, const char *form);
/** read_name - a name with or without quotes, in the arena. NULL: it is not valid. */
char *read_name(struct reader *reader, const char *value, size_t len);
/** take_address - notes that the address has a line. False, and an error at @word, if it had one. */
bool take_address(struct reader *reader, struct iec_addr addr, const struct map_word *word);
/** add_point - puts a point without errors into the map. @word: its address, for the error. */
bool add_point(struct reader *reader, const struct io_point *point, const struct map_word *word);

#ifdef RUNGBOARD_SMALL
#define complain_owner(reader, addr, word) complain(reader, DIAG_IO_TWICE, word)
#define complain_line_twice(reader, point, first, word) \
	complain(reader, (first)->output == (point)->output ? DIAG_IO_LINE_TWICE : DIAG_IO_BOTH_WAYS, word)
static inline bool read_statement(struct reader *reader, const struct map_word *word)
{
	(void)reader, (void)word;
	return false;
}
static inline bool read_channel(struct reader *reader, const struct map_word *address,
				enum driver_id driver, const struct map_word *word)
{
	(void)reader, (void)address, (void)driver, (void)word;
	return false;
}
static inline void finish_net(struct reader *reader)
{
	(void)reader;
}
static inline bool check_net(const struct iomap *map, const struct program *program,
			     struct arena *arena, struct diag_list *diags)
{
	(void)map, (void)program, (void)arena, (void)diags;
	return true;
}
static inline bool has_channel(const struct io_point *point)
{
	(void)point;
	return false;
}
static inline int channel_line_print(const struct io_point *point, char *out, size_t size)
{
	(void)point, (void)out;
	return (int)size;
}
#else
/** complain_owner - LD506: a bit of @addr has a line; names that one. Returns false. */
bool complain_owner(struct reader *reader, struct iec_addr addr, const struct map_word *word);
/** complain_line_twice - LD507 or LD518: @first has the line of @point. Returns false. */
bool complain_line_twice(struct reader *reader, const struct io_point *point, const struct io_point *first,
			 const struct map_word *word);
static inline bool has_channel(const struct io_point *point)
{
	return point->channel;
}
/** read_statement - reads the rest of a line that begins with BUS, SERVE, WINDOW, PUBLISH or MODULE;
 * false: @word is none of them. */
bool read_statement(struct reader *reader, const struct map_word *word);
/** read_channel - reads the rest of a line with a driver whose points have channels; false: it is a bit
 * of a chip. @word: the driver. */
bool read_channel(struct reader *reader, const struct map_word *address, enum driver_id driver,
		  const struct map_word *word);
/** finish_net - when all lines have been read: checks what refers to others, gives the map its buses. */
void finish_net(struct reader *reader);
/** check_net - what others may ask of this board is there. False, and an error for each that is not. */
bool check_net(const struct iomap *map, const struct program *program, struct arena *arena,
	       struct diag_list *diags);
/** channel_line_print - "rs485 1 coil 16", as snprintf(). */
int channel_line_print(const struct io_point *point, char *out, size_t size);
#endif
#endif
