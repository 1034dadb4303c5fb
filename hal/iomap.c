/* SPDX-License-Identifier: MIT
 *
 * iomap - reads the I/O map. A line of it has an address, a driver and options, separated
 * by blanks. Reading goes on after an error. An address, a line or an option that occurs
 * twice is an error.
 */
#include "hal/iomap_read.h"
#include "hal/map_words.h"

#include "engine/base/ascii.h"
#include "engine/base/literal.h"

#include <stdio.h>
#include <string.h>

struct option {
	const char *name;
	enum option_for use;
	bool has_value;
	const char *form;     /* how it is written                            */
	/* False: the value is bad. */
	bool (*set)(struct reader *reader, struct io_point *point,
		    const char *value, size_t len);
};

static bool at_line_end(const struct reader *reader)
{
	enum token_kind kind = reader->lex.token.kind;

	return kind == TOKEN_END || kind == TOKEN_NEWLINE ||
	       lex_is(&reader->lex, "#");
}

bool next_word(struct reader *reader, struct map_word *out)
{
	const struct token *token = &reader->lex.token;
	const char *end;

	if (at_line_end(reader))
		return false;
	out->text = token->text;
	out->line = token->line;
	out->column = token->column;
	out->bad = false;
	do {
		end = token->text + token->len;
		out->bad = out->bad || token->kind == TOKEN_BAD;
		lex_next(&reader->lex);
	} while (token->kind != TOKEN_END && token->kind != TOKEN_NEWLINE &&
		 !token->space_before && token->text == end);
	out->len = (size_t)(end - out->text);
	return true;
}

bool complain(struct reader *reader, enum diag_id id, const struct map_word *word)
{
	struct diag place = {
		.id = id, .file = reader->map.file,
		.line = word->line, .column = word->column,
	};

	reader->errors++;
	return diag_add(reader->diags, place, "%.*s",
			(int)(word->len < LIMIT_ARG ? word->len : LIMIT_ARG),
			word->text);
}

const struct driver *driver_row(enum driver_id id)
{
	static const struct driver *const rows[DRIVER_COUNT] = {
#define DRIVER(id) &driver_##id,
#include "hal/drivers.def"
	};

	return rows[id];
}

enum driver_id driver_find(const char *word, size_t len)
{
	int id = 0;

	while (id < DRIVER_COUNT &&
	       !ascii_is(driver_row((enum driver_id)id)->word, word, len))
		id++;
	return (enum driver_id)id;
}

/* Inside of quotes: $" and $$. */
char *read_name(struct reader *reader, const char *value, size_t len)
{
	char *name;
	size_t out = 0;
	bool quoted = len > 0 && value[0] == '"';

	if (quoted && (len < 2 || value[len - 1] != '"'))
		return NULL;
	if (quoted) {
		value++;
		len -= 2;
	}
	if (len == 0 || len > LIMIT_NAME)
		return NULL;
	name = arena_copy(reader->arena, value, len);
	for (size_t i = 0; name && i < len; i++) {
		if (!quoted && value[i] == '"')
			return NULL;
		if (quoted && value[i] == '$' && ++i == len)
			return NULL;
		name[out++] = value[i];
	}
	if (name)
		name[out] = 0;
	return name;
}

static bool set_line(struct reader *reader, struct io_point *point,
		     const char *value, size_t len)
{
	point->line = read_name(reader, value, len);
	return point->line != NULL;
}

static bool set_chip(struct reader *reader, struct io_point *point,
		     const char *value, size_t len)
{
	point->chip = read_name(reader, value, len);
	return point->chip != NULL;
}

static bool set_offset(struct reader *reader, struct io_point *point,
		       const char *value, size_t len)
{
	uint32_t offset = 0;

	(void)reader;
	for (size_t i = 0; i < len; i++) {
		if (value[i] < '0' || value[i] > '9')
			return false;
		offset = offset * 10 + (uint32_t)(value[i] - '0');
		if (offset > IO_OFFSET_MAX)
			return false;
	}
	point->offset = offset;
	return len > 0;
}

static bool set_debounce(struct reader *reader, struct io_point *point,
			 const char *value, size_t len)
{
	int64_t ns;

	(void)reader;
	if (!literal_parse_duration(value, len, &ns) || ns > IO_DEBOUNCE_MAX_NS)
		return false;
	point->debounce_ns = ns;
	return true;
}

static bool set_safe(struct reader *reader, struct io_point *point,
		     const char *value, size_t len)
{
	(void)reader;
	point->has_safe = true;
	point->hold = ascii_is("hold", value, len);
	point->safe = len == 1 && value[0] == '1';
	return point->hold || point->safe || (len == 1 && value[0] == '0');
}

#define SETTER(name, member, constant)                                        \
	static bool name(struct reader *reader, struct io_point *point,       \
			 const char *value, size_t len)                       \
	{                                                                     \
		(void)reader, (void)value, (void)len;                         \
		point->member = constant;                                     \
		return true;                                                  \
	}
SETTER(set_active_low, active_low, true)
SETTER(set_pull_up, bias, BIAS_UP)
SETTER(set_pull_down, bias, BIAS_DOWN)
SETTER(set_no_pull, bias, BIAS_NONE)
SETTER(set_push_pull, drive, DRIVE_PUSH_PULL)
SETTER(set_open_drain, drive, DRIVE_OPEN_DRAIN)
SETTER(set_open_source, drive, DRIVE_OPEN_SOURCE)

/* Only one of the three pulls is allowed, and one of the three drives. */
enum { FIRST_PULL = 6, FIRST_DRIVE = 9, OPTION_COUNT = 12 };
static const struct option options[OPTION_COUNT] = {
#define CHIP_OPTION(id, text, use, has_value, form, set) { text, use, has_value, form, set },
#include "hal/map_words.def"
};
enum { OPTION_LINE, OPTION_CHIP, OPTION_OFFSET };

/* Options that exclude option @i, including itself; one bit each. */
static unsigned against(int i)
{
	if (i == OPTION_LINE)
		return 1u << OPTION_LINE | 1u << OPTION_CHIP |
		       1u << OPTION_OFFSET;
	if (i == OPTION_CHIP || i == OPTION_OFFSET)
		return 1u << OPTION_LINE | 1u << i;
	if (i >= FIRST_DRIVE)
		return 7u << FIRST_DRIVE;
	if (i >= FIRST_PULL)
		return 7u << FIRST_PULL;
	return 1u << i;
}

bool complain_about(struct reader *reader, enum diag_id id, const struct map_word *word, const char *second)
{
	struct diag place = {
		.id = id, .file = reader->map.file,
		.line = word->line, .column = word->column,
	};

	reader->errors++;
	return diag_add(reader->diags, place, "%.*s" DIAG_AND "%s",
			(int)(word->len < 40 ? word->len : 40), word->text, second);
}

bool complain_form(struct reader *reader, const struct map_word *word, const char *form)
{
	return complain_about(reader, DIAG_IO_VALUE, word, form);
}

static bool read_option(struct reader *reader, struct io_point *point,
			const struct map_word *word, unsigned *seen)
{
	const char *equal = memchr(word->text, '=', word->len);
	size_t name = equal ? (size_t)(equal - word->text) : word->len;
	const char *value = equal ? equal + 1 : NULL;
	int i = 0;

	while (i < OPTION_COUNT && !ascii_is(options[i].name, word->text, name))
		i++;
	if (i == OPTION_COUNT)
		return complain(reader, DIAG_IO_OPTION, word);
	if (*seen & 1u << i)
		return complain(reader, DIAG_IO_OPTION_TWICE, word);
	if (*seen & against(i))
		return complain(reader, DIAG_IO_CONFLICT, word);
	*seen |= 1u << i;
	if (options[i].use == FOR_INPUT && point->output)
		return complain(reader, DIAG_IO_FOR_INPUT, word);
	if (options[i].use == FOR_OUTPUT && !point->output)
		return complain(reader, DIAG_IO_FOR_OUTPUT, word);
	if (options[i].has_value != (value != NULL) ||
	    !options[i].set(reader, point, value,
			    value ? word->len - name - 1 : 0))
		return complain_form(reader, word, options[i].form);
	return true;
}

/* Makes room for the bits of so many bytes; the largest areas would take too much. */
static bool has_room(struct reader *reader, struct taken *taken, uint32_t bytes)
{
	uint32_t size = taken->size ? taken->size : 32;
	uint8_t *more;

	while (size < bytes)
		size *= 2;
	if (size == taken->size)
		return true;
	more = arena_grow(reader->arena, taken->byte, taken->size, size);
	if (!more)
		return false;
	*taken = (struct taken){ more, size };
	return true;
}

bool take_address(struct reader *reader, struct iec_addr addr, const struct map_word *word)
{
	struct taken *taken = &reader->taken[addr.area];
	const uint32_t first = 8 * addr.byte + addr.bit;

	if (!has_room(reader, taken, (first + addr.bits + 7) / 8))
		return false;
	for (uint32_t i = first; i < first + addr.bits; i++) {
		const uint8_t mask = (uint8_t)(1u << i % 8);

		if (taken->byte[i / 8] & mask)
			return complain_owner(reader, addr, word);
		taken->byte[i / 8] |= mask;
	}
	return true;
}

static bool read_address(struct reader *reader, struct io_point *point,
			 const struct map_word *word)
{
	if (iec_addr_parse(word->text, word->len, &point->addr) != ADDR_OK ||
	    point->addr.bits != 1 ||
	    (point->addr.area != AREA_I && point->addr.area != AREA_Q))
		return complain(reader, DIAG_IO_ADDRESS, word);
	point->output = point->addr.area == AREA_Q;
	return take_address(reader, point->addr, word);
}

static bool same_text(const char *a, const char *b)
{
	return a && b && strcmp(a, b) == 0;
}

/* Finds a line that is named twice in the same way; hal_open() finds the others. */
static bool check_twice(struct reader *reader, const struct io_point *point,
			const struct map_word *word)
{
	for (int i = 0; i < reader->map.count; i++) {
		const struct io_point *other = &reader->map.point[i];

		if (other == point || other->driver != point->driver ||
		    !driver_row(point->driver)->needs_line)
			continue;
		if (same_text(other->line, point->line) ||
		    (same_text(other->chip, point->chip) &&
		     other->offset == point->offset))
			return complain_line_twice(reader, point, other, word);
	}
	return true;
}

static bool check_line(struct reader *reader, const struct io_point *point,
		       const struct map_word *word, unsigned seen)
{
	bool by_chip = seen & 1u << OPTION_CHIP;
	bool by_offset = seen & 1u << OPTION_OFFSET;

	if (by_chip != by_offset ||
	    (driver_row(point->driver)->needs_line &&
	     !(seen & 1u << OPTION_LINE) && !by_chip))
		return complain(reader, DIAG_IO_MISSING_LINE, word);
	return check_twice(reader, point, word);
}

void skip_words(struct reader *reader)
{
	struct map_word word;

	while (next_word(reader, &word))
		;
}

bool add_point(struct reader *reader, const struct io_point *point, const struct map_word *word)
{
	struct io_point *kept;

	if (reader->map.count == LIMIT_IO_POINTS)
		return complain(reader, DIAG_IO_TOO_MANY, word);
	kept = arena_push(reader->arena, &reader->map.point, &reader->map.count,
			  sizeof(*kept));
	if (kept)
		*kept = *point;
	return kept;
}

static void read_line(struct reader *reader, const struct map_word *address, enum driver_id driver)
{
	struct io_point point = {
		.driver = driver, .text_line = address->line, .text_column = address->column,
	};
	struct map_word word;
	unsigned seen = 0;
	int before = reader->errors;

	read_address(reader, &point, address);
	while (next_word(reader, &word))
		read_option(reader, &point, &word, &seen);
	if (reader->errors == before && check_line(reader, &point, address, seen))
		add_point(reader, &point, address);
}

static void read_point(struct reader *reader, const struct map_word *address)
{
	struct map_word word;
	enum driver_id driver;

	if (!next_word(reader, &word)) {
		complain(reader, DIAG_IO_SYNTAX, address);
		return;
	}
	driver = driver_find(word.text, word.len);
	if (driver == DRIVER_COUNT) {
		complain(reader, DIAG_IO_DRIVER, &word);
		skip_words(reader);
	} else if (!read_channel(reader, address, driver, &word)) {
		read_line(reader, address, driver);
	}
}

static void read_board(struct reader *reader)
{
	struct map_word word;

	if (!lex_accept(&reader->lex, "BOARD")) {
		word = (struct map_word){ "", 0, reader->lex.token.line,
				      reader->lex.token.column, false };
		complain(reader, DIAG_IO_NO_BOARD, &word);
		if (*reader->lex.token.text != '%') /* not the line of an address either */
			skip_words(reader);
		return;
	}
	if (!next_word(reader, &word)) {
		word = (struct map_word){ "BOARD", 5, reader->lex.token.line, 1,
				      false };
		complain(reader, DIAG_IO_NO_BOARD, &word);
		return;
	}
	reader->map.board = word.bad || word.text[0] != '"' ? NULL :
		read_name(reader, word.text, word.len);
	if (!reader->map.board)
		complain(reader, DIAG_IO_NO_BOARD, &word);
	else if (next_word(reader, &word))
		complain(reader, DIAG_IO_SYNTAX, &word);
	skip_words(reader);
}

static bool skip_empty(struct reader *reader)
{
	for (;;) {
		if (reader->lex.token.kind == TOKEN_END)
			return false;
		if (reader->lex.token.kind == TOKEN_NEWLINE)
			lex_next(&reader->lex);
		else if (lex_is(&reader->lex, "#"))
			lex_skip_line(&reader->lex);
		else
			return true;
	}
}

static void read_lines(struct reader *reader)
{
	struct map_word word;

	if (skip_empty(reader))
		read_board(reader);
	while (skip_empty(reader) && !reader->arena->failed) {
		next_word(reader, &word);
		if (word.bad) {
			complain(reader, DIAG_IO_SYNTAX, &word);
			skip_words(reader);
		} else if (!read_statement(reader, &word)) {
			read_point(reader, &word);
		}
	}
	finish_net(reader);
}

/* Refuses a text that is empty, too large or not UTF-8. */
static bool check_bytes(struct reader *reader, const char *text, size_t len)
{
	struct diag place = { .file = reader->map.file };
	size_t bad;

	if (len == 0) {
		place.id = DIAG_EMPTY_FILE;
		return diag_add(reader->diags, place, "%s", "");
	}
	if (len > LIMIT_TEXT) {
		place.id = DIAG_TOO_LARGE;
		return diag_add(reader->diags, place, "%s", "");
	}
	if (utf8_valid(text, len, &bad))
		return true;
	place.id = utf16_text(text, len) ? DIAG_UTF16 : DIAG_BAD_UTF8;
	place.line = place.column = 1;
	for (size_t i = 0; i < bad; i++) {
		place.column++;
		if (text[i] == '\n') {
			place.line++;
			place.column = 1;
		}
	}
	return diag_add(reader->diags, place, "%s", "");
}

bool iomap_read(struct iomap *map, struct arena *arena, const char *file,
		const char *text, size_t len, struct diag_list *diags)
{
	struct reader reader = {
		.map = { .file = file, .board = "", .dev = "/dev" },
		.arena = arena, .diags = diags,
	};

	*map = reader.map;
	if (!check_bytes(&reader, text, len))
		return false;
	lex_init(&reader.lex, text, len);
	reader.lex.newlines = true;
	lex_next(&reader.lex);
	if (!arena->failed)
		read_lines(&reader);
	if (arena->failed)
		return diag_add(diags, (struct diag){ .id = DIAG_NO_MEMORY,
						      .file = file }, "%s", "");
	*map = reader.map;
	if (reader.errors)
		return false;
	if (!reader.map.board || !reader.map.board[0])
		return diag_add(diags, (struct diag){ .id = DIAG_IO_NO_BOARD,
				.file = file, .line = 1 }, "%s", "");
	return true;
}

bool iomap_fits(const struct iomap *map, const struct areas *areas,
		struct diag_list *diags)
{
	bool good = true;
	char text[24];

	for (int i = 0; i < map->count; i++) {
		const struct io_point *point = &map->point[i];

		if (areas_have(areas, point->addr))
			continue;
		iec_addr_print(point->addr, text, sizeof(text));
		good = diag_add(diags, io_place(map, point, DIAG_IO_OUTSIDE), "%s",
				text);
	}
	return good;
}

struct diag io_place(const struct iomap *map, const struct io_point *point,
		     enum diag_id id)
{
	return (struct diag){
		.id = id, .file = map->file,
		.line = point->text_line, .column = point->text_column,
	};
}

int io_line_print(const struct io_point *point, char *out, size_t size)
{
	if (has_channel(point))
		return channel_line_print(point, out, size);
	if (point->line)
		return snprintf(out, size, "%s", point->line);
	if (point->chip)
		return snprintf(out, size, "%s %u", point->chip,
				(unsigned)point->offset);
	return iec_addr_print(point->addr, out, size);
}
