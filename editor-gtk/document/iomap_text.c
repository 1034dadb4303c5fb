/* SPDX-License-Identifier: MIT
 *
 * iomap_text - the words of an I/O map, and edits of them.
 *
 * An edited line is written in a buffer, word by word. The edit is the difference to the
 * old line.
 */
#include "editor-gtk/document/iomap_text.h"

#include "editor-gtk/kit/i18n.h"

#include "hal/drivers.h"
#include "hal/map_words.h"

#include "engine/base/ascii.h"
#include "engine/base/lex.h"
#include "engine/base/limits.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

struct word {
	const char *text;
	size_t len;
	int line;
};

static bool at_line_end(const struct lex *lex)
{
	const enum token_kind kind = lex->token.kind;

	return kind == TOKEN_END || kind == TOKEN_NEWLINE || lex_is(lex, "#");
}

/* Words in this file are tokens without a blank between them, as in hal/iomap.c. Comments
 * are skipped; one that ends the line is kept in @row (or NULL). */
static void skip_comments(struct lex *lex, const char *text, struct io_row *row)
{
	while (lex->token.kind == TOKEN_COMMENT) {
		if (row && lex->token.text[0] == '/')
			row->comment = (struct io_span){
				(size_t)(lex->token.text - text), lex->token.len };
		lex_next(lex);
	}
}

static bool next_word(struct lex *lex, const char *text, struct io_row *row,
		      struct word *out)
{
	const char *end;

	skip_comments(lex, text, row);
	if (at_line_end(lex))
		return false;
	*out = (struct word){ lex->token.text, 0, lex->token.line };
	do {
		end = lex->token.text + lex->token.len;
		lex_next(lex);
	} while (lex->token.kind != TOKEN_END && lex->token.kind != TOKEN_NEWLINE &&
		 lex->token.kind != TOKEN_COMMENT && !lex->token.space_before &&
		 lex->token.text == end);
	out->len = (size_t)(end - out->text);
	return true;
}

/* ---- what a word is ---- */

static const struct { const char *name; enum io_word word; bool has_value; } option[] = {
#define MAP_WORD(id, text, has_value) { text, IO_WORD_##id, has_value },
#define MAP_ALSO(id, text, has_value) { text, IO_WORD_##id, has_value },
#include "hal/map_words.def"
};

enum io_word io_word_find(const char *text, size_t len)
{
	const char *equal = memchr(text, '=', len);
	const size_t name = equal ? (size_t)(equal - text) : len;

	for (size_t i = 0; i < sizeof(option) / sizeof(*option); i++)
		if (option[i].has_value == (equal != NULL) && ascii_is(option[i].name, text, name))
			return option[i].word;
	return IO_WORDS;
}

const char *io_kind_word(enum io_kind kind)
{
	static const char *const words[IO_KINDS] = {
		"",
#define MAP_STATEMENT(id, read) #id,
#include "hal/map_words.def"
	};

	return words[kind];
}

static enum io_kind statement_of(const struct word *word)
{
	enum io_kind kind = IO_KIND_BUS;

	while (kind < IO_KINDS && !ascii_is(io_kind_word(kind), word->text, word->len))
		kind++;
	return kind < IO_KINDS ? kind : IO_KIND_POINT;
}

#define FIXED 3 /* words before the options, at most                          */

/* Words before the options, in their order. */
static enum io_word fixed_word(enum io_kind kind, int number)
{
	static const enum io_word words[IO_KINDS][FIXED] = {
		[IO_KIND_POINT] = { IO_WORD_ADDRESS, IO_WORD_DRIVER, IO_WORDS },
		[IO_KIND_BUS] = { IO_WORD_STATEMENT, IO_WORD_ADDRESS, IO_WORD_DRIVER },
		[IO_KIND_SERVE] = { IO_WORD_STATEMENT, IO_WORD_ADDRESS, IO_WORD_DRIVER },
		[IO_KIND_WINDOW] = { IO_WORD_STATEMENT, IO_WORD_ADDRESS, IO_WORDS },
		[IO_KIND_PUBLISH] = { IO_WORD_STATEMENT, IO_WORD_ADDRESS, IO_WORDS },
		[IO_KIND_MODULE] = { IO_WORD_STATEMENT, IO_WORD_ADDRESS, IO_WORDS },
		[IO_KIND_DEVICE] = { IO_WORD_STATEMENT, IO_WORD_ADDRESS, IO_WORDS },
	};

	return number < FIXED ? words[kind][number] : IO_WORDS;
}

static void take(const struct io_text *io, struct io_row *row, enum io_word kind,
		 const struct word *word)
{
	if (kind < IO_WORDS && row->word[kind].len == 0)
		row->word[kind] = (struct io_span){ (size_t)(word->text - io->text),
						    word->len };
	row->words_end = (size_t)(word->text - io->text) + word->len;
}

static bool only_blanks(const char *text, size_t len)
{
	for (size_t i = 0; i < len; i++)
		if (text[i] != ' ' && text[i] != '\t')
			return false;
	return true;
}

/* The names of a PUBLISH are several words with blanks between them. */
static bool take_name(const struct io_text *io, struct io_row *row, const struct word *word)
{
	struct io_span *names = &row->word[IO_WORD_NAMES];
	const size_t end = names->at + names->len, at = (size_t)(word->text - io->text);

	if (row->kind != IO_KIND_PUBLISH || memchr(word->text, '=', word->len))
		return false;
	if (!names->len)
		take(io, row, IO_WORD_NAMES, word);
	else if (row->words_end == end && only_blanks(io->text + end, at - end))
		names->len = at + word->len - names->at;
	row->words_end = at + word->len;
	return true;
}

/* @before: the kind of the word before it. Returns its own. */
static enum io_word take_option(const struct io_text *io, struct io_row *row,
				enum io_word before, const struct word *word)
{
	enum io_word kind = io_word_find(word->text, word->len);

	if (take_name(io, row, word))
		return IO_WORD_NAMES;
	if (before == IO_WORD_RANGE && ascii_is("at", word->text, word->len))
		kind = IO_WORD_AT;
	else if (before == IO_WORD_AT)
		kind = IO_WORD_AT_VALUE;
	else if (row->kind == IO_KIND_WINDOW && word->text[0] == '%')
		kind = IO_WORD_SHOWN;
	if (kind < IO_WORDS && row->word[kind].len) { /* given twice */
		take(io, row, IO_WORDS, word);
		return IO_WORDS;
	}
	take(io, row, kind, word);
	return kind;
}

/* ---- lines ---- */

/* The place of the newline, or of a carriage return before it. */
static size_t end_of_line(const struct io_text *io, size_t at)
{
	const char *newline = memchr(io->text + at, '\n', io->len - at);
	size_t end = newline ? (size_t)(newline - io->text) : io->len;

	while (end > at && io->text[end - 1] == '\r')
		end--;
	return end;
}

static size_t begin_of_line(const struct io_text *io, size_t at, size_t least)
{
	while (at > least && io->text[at - 1] != '\n')
		at--;
	return at;
}

/* Ends a row: finds its comment and the end of its line. */
static void end_row(struct io_text *io, struct lex *lex, struct io_row *row)
{
	row->end = end_of_line(io, row->words_end);
	if (lex->token.kind == TOKEN_NEWLINE)
		row->end = end_of_line(io, (size_t)(lex->token.text - io->text));
	if (!lex_is(lex, "#"))
		return;
	row->comment.at = (size_t)(lex->token.text - io->text);
	row->end = end_of_line(io, row->comment.at);
	row->comment.len = row->end - row->comment.at;
}

static struct io_row *push_row(struct io_text *io)
{
	struct io_row *more;

	if ((io->count & (io->count - 1)) == 0) {
		more = realloc(io->row, (size_t)(io->count ? 2 * io->count : 1) *
			       sizeof(*more));
		if (!more)
			return NULL;
		io->row = more;
	}
	more = &io->row[io->count++];
	memset(more, 0, sizeof(*more));
	return more;
}

static void read_board(struct io_text *io, struct lex *lex, const struct word *first)
{
	struct word word;

	io->board_line = first->line;
	if (next_word(lex, io->text, NULL, &word))
		io->board = (struct io_span){ (size_t)(word.text - io->text), word.len };
	while (next_word(lex, io->text, NULL, &word))
		;
}

/* @least: the end of the row before. */
static bool read_row(struct io_text *io, struct lex *lex, const struct word *first,
		     size_t least)
{
	struct io_row *row = push_row(io);
	enum io_word kind;
	struct word word;
	int number = 1;

	if (!row)
		return false;
	row->kind = statement_of(first);
	row->line = first->line;
	row->from = begin_of_line(io, (size_t)(first->text - io->text), least);
	kind = fixed_word(row->kind, 0);
	take(io, row, kind, first);
	while (next_word(lex, io->text, row, &word)) {
		if (fixed_word(row->kind, number) == IO_WORDS) {
			kind = take_option(io, row, kind, &word);
			continue;
		}
		kind = fixed_word(row->kind, number++);
		take(io, row, kind, &word);
	}
	end_row(io, lex, row);
	return true;
}

bool io_text_read(struct io_text *out, const char *text, size_t len)
{
	struct lex lex;
	struct word word;
	bool first = true;
	size_t least = 0;

	*out = (struct io_text){ .text = text, .len = len };
	lex_init(&lex, text, len);
	lex.newlines = lex.comments = true;
	lex_next(&lex);
	while (lex.token.kind != TOKEN_END) {
		if (lex.token.kind == TOKEN_COMMENT) {
			least = (size_t)(lex.token.text - text) + lex.token.len;
			lex_next(&lex);
		} else if (lex.token.kind == TOKEN_NEWLINE) {
			lex_next(&lex);
		} else if (!next_word(&lex, text, NULL, &word)) {
			lex_skip_line(&lex); /* # */
		} else {
			if (first && ascii_is("BOARD", word.text, word.len))
				read_board(out, &lex, &word);
			else if (!read_row(out, &lex, &word, least))
				return false;
			first = false;
		}
	}
	return true;
}

void io_text_free(struct io_text *io)
{
	free(io->row);
	*io = (struct io_text){ .text = NULL };
}

/* ---- what cells show ---- */

/* Copies a name without its quotes. */
static size_t unquote(const char *value, size_t len, char *out)
{
	size_t used = 0;

	if (len < 2 || value[0] != '"' || value[len - 1] != '"') {
		memcpy(out, value, len);
		return len;
	}
	for (size_t i = 1; i + 1 < len; i++) {
		if (value[i] == '$' && i + 2 < len)
			i++;
		out[used++] = value[i];
	}
	return used;
}

static struct io_span value_of(const struct io_text *io, const struct io_span *word)
{
	const char *equal = memchr(io->text + word->at, '=', word->len);
	const size_t skip = equal ? (size_t)(equal - io->text) + 1 - word->at : 0;

	return (struct io_span){ word->at + skip, word->len - skip };
}

static bool has_blank(const char *text, size_t len)
{
	return memchr(text, ' ', len) || memchr(text, '\t', len);
}

/* A name with blanks keeps its quotes: without them it would read as label and offset. */
static size_t put_name(const struct io_text *io, const struct io_span *word, char *out)
{
	const struct io_span value = value_of(io, word);

	if (!word->len)
		return 0;
	if (has_blank(io->text + value.at, value.len)) {
		memcpy(out, io->text + value.at, value.len);
		return value.len;
	}
	return unquote(io->text + value.at, value.len, out);
}

static size_t put_line(const struct io_text *io, const struct io_row *row, char *out)
{
	const struct io_span offset = value_of(io, &row->word[IO_WORD_OFFSET]);
	size_t len;

	if (row->word[IO_WORD_LINE].len)
		return put_name(io, &row->word[IO_WORD_LINE], out);
	len = put_name(io, &row->word[IO_WORD_CHIP], out);
	if (!offset.len)
		return len;
	if (len)
		out[len++] = ' ';
	memcpy(out + len, io->text + offset.at, offset.len);
	return len + offset.len;
}

static size_t put_comment(const struct io_text *io, const struct io_span *comment,
			  char *out)
{
	const char *at = io->text + comment->at, *end = at + comment->len;

	while (at < end && (*at == '#' || *at == '/'))
		at++;
	while (at < end && (*at == ' ' || *at == '\t'))
		at++;
	while (end > at && (end[-1] == ' ' || end[-1] == '\t' || end[-1] == '\r'))
		end--;
	memcpy(out, at, (size_t)(end - at));
	return (size_t)(end - at);
}

/* Fields of one word. IO_WORDS: of several words. */
static const struct field_row {
	const char *name;
	enum io_word word;
} fields[IO_FIELDS] = {
	[IO_ADDRESS] = { N_("Address"), IO_WORD_ADDRESS },
	[IO_DRIVER] = { N_("Driver"), IO_WORD_DRIVER },
	[IO_LINE] = { N_("I/O line"), IO_WORDS },
	[IO_PULL] = { N_("Pull"), IO_WORD_PULL },
	[IO_ACTIVE_LOW] = { N_("Active low"), IO_WORD_ACTIVE_LOW },
	[IO_DEBOUNCE] = { N_("Debounce"), IO_WORD_DEBOUNCE },
	[IO_DRIVE] = { N_("Drive"), IO_WORD_DRIVE },
	[IO_DEVICE] = { N_("Device"), IO_WORDS },
	[IO_CHANNEL] = { N_("Channel"), IO_WORDS },
	[IO_PERIOD] = { N_("Period"), IO_WORD_PERIOD },
	[IO_BUS] = { N_("Bus"), IO_WORD_BUS },
	[IO_UNIT] = { N_("Unit"), IO_WORD_UNIT },
	[IO_TYPE] = { N_("Module type"), IO_WORD_TYPE },
	[IO_TABLE] = { N_("Table"), IO_WORDS },
	[IO_NUMBER] = { N_("Number"), IO_WORDS },
	[IO_BIT] = { N_("Bit"), IO_WORD_BIT },
	[IO_AS] = { N_("Value type"), IO_WORD_AS },
	[IO_RAW] = { N_("Register type"), IO_WORD_RAW },
	[IO_WORD_ORDER] = { N_("Word order"), IO_WORD_WORD_ORDER },
	[IO_BYTE_ORDER] = { N_("Byte order"), IO_WORD_BYTE_ORDER },
	[IO_RANGE] = { N_("Range"), IO_WORDS },
	[IO_LIMITS] = { N_("Limits"), IO_WORD_LIMITS },
	[IO_THRESHOLD] = { N_("Threshold"), IO_WORD_THRESHOLD },
	[IO_HYSTERESIS] = { N_("Hysteresis"), IO_WORD_HYSTERESIS },
	[IO_FILTER] = { N_("Filter time"), IO_WORD_FILTER },
	[IO_POLL] = { N_("Poll"), IO_WORD_POLL },
	[IO_STALE] = { N_("Stale"), IO_WORD_STALE },
	[IO_SUBSTITUTE] = { N_("Substitute"), IO_WORD_SUBSTITUTE },
	[IO_REFRESH] = { N_("Refresh"), IO_WORD_REFRESH },
	[IO_ON_CHANGE] = { N_("On change"), IO_WORD_ON_CHANGE },
	[IO_ASK] = { N_("Asked by"), IO_WORD_ASK },
	[IO_OF] = { N_("Quality of"), IO_WORD_OF },
	[IO_SAFE] = { N_("Safe"), IO_WORD_SAFE },
	[IO_PORT] = { N_("Port"), IO_WORD_PORT },
	[IO_BAUD] = { N_("Baud rate"), IO_WORD_BAUD },
	[IO_PARITY] = { N_("Parity"), IO_WORD_PARITY },
	[IO_STOP_BITS] = { N_("Stop bits"), IO_WORD_STOP_BITS },
	[IO_HOST] = { N_("Host"), IO_WORD_HOST },
	[IO_INTERFACE] = { N_("Interface"), IO_WORD_INTERFACE },
	[IO_GROUP] = { N_("Group address"), IO_WORD_GROUP },
	[IO_TIMEOUT] = { N_("Timeout"), IO_WORD_TIMEOUT },
	[IO_LISTEN] = { N_("Listen"), IO_WORD_LISTEN },
	[IO_CONNECTIONS] = { N_("Connections"), IO_WORD_CONNECTIONS },
	[IO_RATE] = { N_("Requests/s"), IO_WORD_RATE },
	[IO_ACCESS] = { N_("Access"), IO_WORD_ACCESS },
	[IO_NAMES] = { N_("Variables"), IO_WORD_NAMES },
	[IO_EVERY] = { N_("Every"), IO_WORD_EVERY },
	[IO_DI] = { N_("DI"), IO_WORD_DI }, [IO_DQ] = { N_("DQ"), IO_WORD_DQ },
	[IO_AI] = { N_("AI"), IO_WORD_AI }, [IO_AQ] = { N_("AQ"), IO_WORD_AQ },
	[IO_FIRST_DI] = { N_("First DI"), IO_WORD_DISCRETE_INPUT },
	[IO_FIRST_DQ] = { N_("First DQ"), IO_WORD_COIL },
	[IO_FIRST_AI] = { N_("First AI"), IO_WORD_INPUT_REGISTER },
	[IO_FIRST_AQ] = { N_("First AQ"), IO_WORD_HOLDING_REGISTER },
	[IO_READ_REGISTERS] = { N_("Registers a read"), IO_WORD_READ_REGISTERS },
	[IO_WRITE_REGISTERS] = { N_("Registers a write"), IO_WORD_WRITE_REGISTERS },
	[IO_READ_COILS] = { N_("Coils a read"), IO_WORD_READ_COILS },
	[IO_WRITE_COILS] = { N_("Coils a write"), IO_WORD_WRITE_COILS },
	[IO_GAP] = { N_("Gap"), IO_WORD_GAP },
	[IO_TOGETHER] = { N_("Together"), IO_WORD_TOGETHER },
	[IO_COMMENT] = { N_("Comment"), IO_WORDS },
};

/* The words of fields that have several; the last row of each list ends it. */
static const enum io_word line_words[] = { IO_WORD_LINE, IO_WORD_CHIP, IO_WORD_OFFSET, IO_WORDS };
static const enum io_word device_words[] = { IO_WORD_DEVICE, IO_WORD_CHIP, IO_WORD_SENSOR, IO_WORD_FROM, IO_WORDS };
static const enum io_word channel_words[] = { IO_WORD_CHANNEL, IO_WORD_NAME, IO_WORDS };
static const enum io_word range_words[] = { IO_WORD_RANGE, IO_WORD_AT, IO_WORD_AT_VALUE, IO_WORDS };
static const enum io_word table_words[] = {
#define TABLE_WORD(id, text, of_bits) IO_WORD_##id,
#include "hal/map_words.def"
	IO_WORDS
};

const enum io_word *io_field_words(enum io_kind kind, enum io_field field)
{
	static const enum io_word one[IO_WORDS + 1][2] = {
#define MAP_PART(id) [IO_WORD_##id] = { IO_WORD_##id, IO_WORDS },
#define MAP_WORD(id, text, has_value) [IO_WORD_##id] = { IO_WORD_##id, IO_WORDS },
#include "hal/map_words.def"
		[IO_WORDS] = { IO_WORDS },
	};

	switch ((int)field) {
	case IO_LINE: return line_words;
	case IO_DEVICE: return device_words;
	case IO_CHANNEL: return channel_words;
	case IO_RANGE: return range_words;
	case IO_TABLE: case IO_NUMBER: return kind == IO_KIND_MODULE ? one[IO_WORDS] : table_words;
	case IO_FIRST_DI: case IO_FIRST_DQ: case IO_FIRST_AI: case IO_FIRST_AQ:
		return one[kind == IO_KIND_MODULE ? fields[field].word : IO_WORDS];
	default: return one[fields[field].word];
	}
}

static bool has_word(enum io_kind kind, enum io_field field, enum io_word word)
{
	const enum io_word *of = io_field_words(kind, field);

	while (*of != IO_WORDS && *of != word)
		of++;
	return *of != IO_WORDS;
}

static bool word_is(const struct io_text *io, const struct io_span *word, const char *text)
{
	return ascii_is(text, io->text + word->at, word->len);
}

#define ON_OTHER (1u << DRIVER_COUNT) /* a driver that this program does not know */

/* A bit of map_words.h. */
static unsigned driver_of(const struct io_text *io, const struct io_row *row)
{
	const struct io_span *word = &row->word[IO_WORD_DRIVER];

	return 1u << driver_find(io->text + word->at, word->len);
}

/* Which points may have a word. */
static const struct {
	enum io_word word;
	unsigned drivers;
	enum option_for use;
	bool of_chip;
} point_options[] = {
#define CHIP_OPTION(id, text, use, has_value, form, set) { IO_WORD_##id, ON_GPIO | ON_SIM | ON_OTHER, use, true },
#define VALUE_OPTION(id, text, drivers, use, form, set) { IO_WORD_##id, drivers, use, false },
#include "hal/map_words.def"
};

/* Whether inputs have it, and outputs; all that may be a bit of a chip, and modules, have both. */
static bool fits_direction(const struct io_text *io, const struct io_row *row, enum option_for use)
{
	const struct io_span *address = &row->word[IO_WORD_ADDRESS];
	struct io_values values;

	if (use == FOR_BOTH || driver_of(io, row) & (ON_GPIO | ON_SIM | ON_MODULE | ON_OTHER) ||
	    !io_values_read(io->text + address->at, address->len, &values))
		return true;
	return (iec_area_row(values.first.area)->access == ACCESS_WRITE) == (use == FOR_OUTPUT);
}

static bool point_has(const struct io_text *io, const struct io_row *row, enum io_field field)
{
	const unsigned driver = driver_of(io, row);

	for (size_t i = 0; i < sizeof(point_options) / sizeof(*point_options); i++) {
		if (field == (point_options[i].of_chip ? IO_DEVICE : IO_LINE))
			continue; /* chip= is a word of both                     */
		if (point_options[i].drivers & driver && has_word(IO_KIND_POINT, field, point_options[i].word) &&
		    fits_direction(io, row, point_options[i].use))
			return true;
	}
	return false;
}

/* Kinds of the bus or the server, as bits; unknown ones are all. */
static unsigned protocol_of(const struct io_text *io, const struct io_row *row)
{
	const struct io_span *word = &row->word[IO_WORD_DRIVER];

	return word_is(io, word, "modbus-rtu") ? OF_RTU : word_is(io, word, "modbus-tcp") ? OF_TCP :
	       word_is(io, word, "peer") ? OF_PEER : OF_RTU | OF_TCP | OF_PEER;
}

static bool bus_has(const struct io_text *io, const struct io_row *row, enum io_field field)
{
	static const struct { enum io_word word; unsigned kinds[2]; } bus_options[] = {
#define BUS_OPTION(id, text, buses, servers, form, set) { IO_WORD_##id, { buses, servers } },
#include "hal/map_words.def"
	};

	for (size_t i = 0; i < sizeof(bus_options) / sizeof(*bus_options); i++)
		if (has_word(row->kind, field, bus_options[i].word) &&
		    bus_options[i].kinds[row->kind == IO_KIND_SERVE] & protocol_of(io, row))
			return true;
	return field == IO_DRIVER;
}

/* Options of the lines that are no points, no buses and no servers. */
static bool line_has(enum io_kind kind, enum io_field field)
{
	static const struct { enum io_kind kind; enum io_word word; } options[] = {
#define TABLE_WORD(id, text, of_bits) { IO_KIND_WINDOW, IO_WORD_##id }, { IO_KIND_MODULE, IO_WORD_##id },
#define PUBLISH_OPTION(id, text, form, set) { IO_KIND_PUBLISH, IO_WORD_##id },
#define MODULE_OPTION(id, text, table) { IO_KIND_MODULE, IO_WORD_##id },
#define DEVICE_OPTION(id, text, form, most, least, member) { IO_KIND_DEVICE, IO_WORD_##id },
#define DEVICE_ORDER(id, text, form, member) { IO_KIND_DEVICE, IO_WORD_##id },
#define DEVICE_FLAG(id, text, member) { IO_KIND_DEVICE, IO_WORD_##id },
#include "hal/map_words.def"
		{ IO_KIND_WINDOW, IO_WORD_BUS }, { IO_KIND_WINDOW, IO_WORD_ACCESS }, { IO_KIND_PUBLISH, IO_WORD_NAMES },
	};

	for (size_t i = 0; i < sizeof(options) / sizeof(*options); i++)
		if (options[i].kind == kind && has_word(kind, field, options[i].word))
			return true;
	return false;
}

/* The one word of a field; IO_WORDS: it has several. */
static enum io_word word_of(const struct io_row *row, enum io_field field)
{
	if (row->kind == IO_KIND_WINDOW && field == IO_ADDRESS)
		return IO_WORD_SHOWN;
	if (row->kind == IO_KIND_WINDOW && field == IO_BUS)
		return IO_WORD_ADDRESS;
	return fields[field].word;
}

/* A word that should not be there can be seen, and deleted. */
static bool is_there(const struct io_row *row, enum io_field field)
{
	const enum io_word word = word_of(row, field);

	return word < IO_WORDS && row->word[word].len &&
	       !(field >= IO_FIRST_DI && field <= IO_FIRST_AQ);
}

bool io_text_has(const struct io_text *io, int number, enum io_field field)
{
	const struct io_row *row = &io->row[number];

	if (field == IO_ADDRESS || field == IO_COMMENT || is_there(row, field))
		return true;
	switch (row->kind) {
	case IO_KIND_POINT:
		return field == IO_DRIVER || point_has(io, row, field);
	case IO_KIND_BUS: case IO_KIND_SERVE:
		return bus_has(io, row, field);
	case IO_KIND_WINDOW: case IO_KIND_PUBLISH: case IO_KIND_MODULE: case IO_KIND_DEVICE:
		return line_has(row->kind, field);
	case IO_KINDS: break;
	}
	return false;
}

/* The first of these words that the row has; IO_WORDS: none. */
static enum io_word first_of(const struct io_row *row, const enum io_word *words)
{
	while (*words != IO_WORDS && !row->word[*words].len)
		words++;
	return *words;
}

static const char *option_name(enum io_word word)
{
	for (size_t i = 0; i < sizeof(option) / sizeof(*option); i++)
		if (option[i].word == word)
			return option[i].name;
	return "";
}

static bool has_value(enum io_word word)
{
	for (size_t i = 0; i < sizeof(option) / sizeof(*option); i++)
		if (option[i].word == word)
			return option[i].has_value;
	return false;
}

/* What stands before the value of a word: "period=", "active-low" of a flag, else "". */
static void put_before(enum io_word word, bool flag, char *out, size_t size)
{
	const bool value = has_value(word);

	snprintf(out, size, "%s%s", value || flag ? option_name(word) : "", value ? "=" : "");
}

static size_t put_first(const struct io_text *io, const struct io_row *row,
			const enum io_word *words, char *out)
{
	const enum io_word word = first_of(row, words);

	return word == IO_WORDS ? 0 : put_name(io, &row->word[word], out);
}

static size_t put_table(const struct io_row *row, char *out)
{
	const enum io_word word = first_of(row, table_words);
	const char *name = word == IO_WORDS ? "" : option_name(word);

	memcpy(out, name, strlen(name));
	return strlen(name);
}

static size_t put_value(const struct io_text *io, const struct io_span *word, char *out)
{
	const struct io_span value = value_of(io, word);

	memcpy(out, io->text + value.at, value.len);
	return value.len;
}

static size_t put_range(const struct io_text *io, const struct io_row *row, char *out)
{
	const struct io_span *at = &row->word[IO_WORD_AT_VALUE];
	size_t len = put_value(io, &row->word[IO_WORD_RANGE], out);

	if (!at->len)
		return len;
	memcpy(out + len, " at ", 4);
	memcpy(out + len + 4, io->text + at->at, at->len);
	return len + 4 + at->len;
}

bool io_field_is_flag(enum io_field field)
{
	return field == IO_ACTIVE_LOW || field == IO_ON_CHANGE || field == IO_TOGETHER;
}

/* Names stand in quotes if they must. */
static bool is_name(const struct io_row *row, enum io_field field)
{
	return (field == IO_ADDRESS && row->kind != IO_KIND_POINT && row->kind != IO_KIND_WINDOW) ||
	       field == IO_PORT || field == IO_INTERFACE;
}

/* A field of one word. */
static size_t put_word(const struct io_text *io, const struct io_row *row, enum io_field field,
		       char *out)
{
	const struct io_span *word = &row->word[word_of(row, field)];

	if (io_field_is_flag(field)) {
		out[0] = '1';
		return word->len > 0;
	}
	if (is_name(row, field))
		return put_name(io, word, out);
	if (has_value(word_of(row, field)))
		return put_value(io, word, out);
	memcpy(out, io->text + word->at, word->len);
	return word->len;
}

static size_t put_field(const struct io_text *io, const struct io_row *row, enum io_field field,
			char *out)
{
	switch ((int)field) {
	case IO_COMMENT: return put_comment(io, &row->comment, out);
	case IO_LINE: return put_line(io, row, out);
	case IO_DEVICE: return put_first(io, row, device_words, out);
	case IO_CHANNEL: return put_first(io, row, channel_words, out);
	case IO_TABLE: return put_table(row, out);
	case IO_NUMBER: return put_first(io, row, table_words, out);
	case IO_RANGE: return put_range(io, row, out);
	default: return put_word(io, row, field, out);
	}
}

char *io_text_field(const struct io_text *io, int number, enum io_field field)
{
	const struct io_row *row = &io->row[number];
	char *out = malloc(row->end - row->from + 32); /* more than any field of the row */
	size_t len = 0;

	if (!out)
		return NULL;
	if (io_text_has(io, number, field))
		len = put_field(io, row, field, out);
	out[len] = '\0';
	return out;
}

const char *io_field_name(enum io_field field)
{
	return _(fields[field].name);
}

char *io_text_board(const struct io_text *io)
{
	char *out = malloc(io->board.len + 1);

	if (out)
		out[unquote(io->text + io->board.at, io->board.len, out)] = '\0';
	return out;
}

/* A line that is being written; spans count from the start of the text. */
struct draft {
	char *text;
	size_t len, room;
	bool failed;
};

static void splice(struct draft *draft, size_t at, size_t removed, const char *with)
{
	const size_t come = strlen(with);
	char *more;

	if (draft->failed)
		return;
	if (draft->len - removed + come >= draft->room) { /* with the NUL */
		draft->room = draft->len + come + 64;
		more = realloc(draft->text, draft->room);
		draft->failed = !more;
		if (!more)
			return;
		draft->text = more;
	}
	memmove(draft->text + at + come, draft->text + at + removed,
		draft->len - at - removed);
	memcpy(draft->text + at, with, come);
	draft->len += come - removed;
}

static bool is_blank(char c)
{
	return c == ' ' || c == '\t';
}

/* Counts the blanks at a place of the draft. */
static size_t blanks(const struct draft *draft, size_t at)
{
	size_t count = 0;

	while (at + count < draft->len && draft->text[at + count] == ' ')
		count++;
	return count;
}

static bool is_end(const struct draft *draft, size_t at)
{
	return at >= draft->len || draft->text[at] == '\r' || draft->text[at] == '\n';
}

/* Columns on the screen, not bytes. */
static int width(const char *text, size_t len)
{
	return utf8_width(text, len);
}

/* Keeps the next word in its column if there are enough blanks. */
static void keep_column(struct draft *draft, size_t end, int grown)
{
	const size_t have = blanks(draft, end);

	if (have < 2 && grown >= 0)
		return;
	if (have == 0 || is_end(draft, end + have))
		return;
	if (grown > 0)
		splice(draft, end, (size_t)grown < have ? (size_t)grown : have - 1, "");
	for (; grown < 0 && have >= 2; grown++)
		splice(draft, end, 0, " ");
}

static void replace_word(struct draft *draft, size_t at, size_t len, const char *with)
{
	const int before = width(draft->text + at, len);

	splice(draft, at, len, with);
	if (!draft->failed)
		keep_column(draft, at + strlen(with), width(with, strlen(with)) - before);
}

static void remove_word(struct draft *draft, size_t at, size_t len)
{
	size_t from = at;
	int gone;

	while (from > 0 && is_blank(draft->text[from - 1]))
		from--;
	gone = width(draft->text + from, at + len - from);
	splice(draft, from, at + len - from, "");
	keep_column(draft, from, -gone);
}

/* Inserts a word behind the word that ends at @at. */
static void insert_word(struct draft *draft, size_t at, const char *word)
{
	const int come = width(word, strlen(word)) + 1;

	splice(draft, at, 0, word);
	splice(draft, at, 0, " ");
	if (!draft->failed)
		keep_column(draft, at + strlen(word) + 1, come);
}

/* ---- edits ---- */

static bool draft_open(struct draft *draft, const struct io_text *io,
		       const struct io_row *row)
{
	draft->len = row->end - row->from;
	draft->room = draft->len + 64;
	draft->text = malloc(draft->room);
	draft->failed = !draft->text;
	if (draft->text)
		memcpy(draft->text, io->text + row->from, draft->len);
	return draft->text != NULL;
}

/* Reduces the edit to the bytes that differ, so that undo and cursor go there. */
static enum io_refusal draft_close(struct draft *draft, const struct io_text *io,
				   const struct io_row *row, struct io_edit *edit)
{
	const char *was = io->text + row->from;
	const size_t len = row->end - row->from;
	size_t same = 0, tail = 0;

	if (draft->failed) {
		free(draft->text);
		return IO_MEMORY;
	}
	while (same < len && same < draft->len && was[same] == draft->text[same])
		same++;
	while (tail < len - same && tail < draft->len - same &&
	       was[len - 1 - tail] == draft->text[draft->len - 1 - tail])
		tail++;
	/* not in the middle of a character */
	while (same > 0 && ((unsigned char)was[same] & 0xc0) == 0x80)
		same--;
	while (tail > 0 && ((unsigned char)was[len - tail] & 0xc0) == 0x80)
		tail--;
	edit->at = row->from + same;
	edit->removed = len - same - tail;
	memmove(draft->text, draft->text + same, draft->len - same - tail);
	draft->text[draft->len - same - tail] = '\0';
	edit->with = draft->text;
	return IO_GOOD;
}

/* Where a word of @kind goes: behind the words that come before it in the usual order. */
static size_t place_of(const struct io_row *row, enum io_word kind)
{
	size_t at = row->words_end;

	for (int i = (int)kind - 1; i >= 0; i--)
		if (row->word[i].len)
			return row->word[i].at + row->word[i].len - row->from;
	return at - row->from;
}

/* @word: "pull-up", "safe=0"; "" deletes the word. */
static void set_word(struct draft *draft, const struct io_row *row, enum io_word kind,
		     const char *word)
{
	const struct io_span *span = &row->word[kind];

	if (span->len && *word)
		replace_word(draft, span->at - row->from, span->len, word);
	else if (span->len)
		remove_word(draft, span->at - row->from, span->len);
	else if (*word)
		insert_word(draft, place_of(row, kind), word);
}

/* ---- values ---- */

static bool is_one_word(const char *text)
{
	struct lex lex;
	const char *end = text + strlen(text);

	lex_init(&lex, text, strlen(text));
	lex.newlines = lex.comments = true;
	lex_next(&lex);
	if (lex.token.text != text || lex_is(&lex, "#"))
		return false;
	while (lex.token.kind != TOKEN_END) {
		if (lex.token.kind == TOKEN_NEWLINE || lex.token.kind == TOKEN_COMMENT ||
		    lex.token.kind == TOKEN_BAD ||
		    (lex.token.space_before && lex.token.text != text))
			return false;
		lex_next(&lex);
	}
	return end > text && !is_blank(end[-1]) && end[-1] != '\n' && end[-1] != '\r';
}

static bool has_control(const char *text)
{
	for (; *text; text++)
		if ((unsigned char)*text < 0x20 || *text == 0x7f)
			return true;
	return false;
}

/* Writes a name as a map needs it: in quotes unless it is one bare word. */
static bool spell_name(char *out, size_t room, const char *name, size_t len)
{
	size_t used = 0;
	bool quoted = len == 0;

	if (len + 3 > room)
		return false;
	memcpy(out, name, len);
	out[len] = '\0';
	quoted = quoted || strpbrk(out, "\"$'#") || strstr(out, "(*") || !is_one_word(out);
	if (!quoted)
		return true;
	out[used++] = '"';
	for (size_t i = 0; i < len; i++) {
		if (used + 4 > room)
			return false;
		if (name[i] == '"' || name[i] == '$')
			out[used++] = '$';
		out[used++] = name[i];
	}
	out[used++] = '"';
	out[used] = '\0';
	return true;
}

/* The same for a name that may already have quotes. */
static bool spell_typed(char *out, size_t room, const char *name, size_t len)
{
	if (len < 2 || name[0] != '"' || name[len - 1] != '"')
		return spell_name(out, room, name, len);
	if (len + 1 > room)
		return false;
	memcpy(out, name, len);
	out[len] = '\0';
	return is_one_word(out);
}

/* The start of the last word; @len: there is only one. */
static size_t last_word(const char *text, size_t len)
{
	size_t at = len;

	while (at > 0 && !is_blank(text[at - 1]))
		at--;
	return at;
}

static bool is_number(const char *text, size_t len)
{
	return len > 0 && strspn(text, "0123456789") >= len;
}

#define NAME_ROOM (2 * LIMIT_NAME + 8)

/* Splits "GPIO17", "\"P9_14 [x]\"" or "1c20800.pinctrl 7" into the words of the map;
 * @second "": one word. */
static enum io_refusal spell_line(const char *value, char *first, char *second)
{
	const size_t len = strlen(value), at = last_word(value, len);
	size_t label = at;

	while (label > 0 && is_blank(value[label - 1]))
		label--;
	second[0] = '\0';
	if (label > 0 && value[len - 1] != '"' && is_number(value + at, len - at)) {
		memcpy(first, "chip=", 5);
		memcpy(second, "offset=", 7);
		if (len - at >= 16)
			return IO_BAD_OFFSET;
		memcpy(second + 7, value + at, len - at + 1);
		return spell_typed(first + 5, NAME_ROOM - 5, value, label) ? IO_GOOD :
		       IO_BAD_NAME;
	}
	memcpy(first, "line=", 5);
	return spell_typed(first + 5, NAME_ROOM - 5, value, len) ? IO_GOOD : IO_BAD_NAME;
}

/* Replaces the words of a line's place. Backwards, so that the places of earlier words stay
 * valid. */
static void set_place(struct draft *draft, const struct io_row *row, const char *first,
		      const char *second)
{
	const struct io_span *chip = &row->word[IO_WORD_CHIP];
	const struct io_span *offset = &row->word[IO_WORD_OFFSET];
	const bool both = *second && chip->len && offset->len && chip->at < offset->at &&
			  !row->word[IO_WORD_LINE].len;
	enum io_word order[] = { IO_WORD_LINE, IO_WORD_CHIP, IO_WORD_OFFSET };
	char whole[2 * NAME_ROOM];
	enum io_word target = IO_WORD_LINE;

	while (target < IO_WORD_OFFSET && !row->word[target].len)
		target++;
	if (!row->word[target].len)
		target = IO_WORD_LINE;
	snprintf(whole, sizeof(whole), "%s%s%s", first, *second && !both ? " " : "",
		 both ? "" : second);
	for (int i = 0; i < 3; i++)
		for (int k = 0; k < 2; k++)
			if (row->word[order[k]].at < row->word[order[k + 1]].at) {
				const enum io_word other = order[k];

				order[k] = order[k + 1];
				order[k + 1] = other;
			}
	for (int i = 0; i < 3; i++)
		set_word(draft, row, order[i], order[i] == target ? whole :
			 both && order[i] == IO_WORD_OFFSET ? second : "");
}

static enum io_refusal set_line(struct draft *draft, const struct io_row *row,
				const char *value)
{
	char first[NAME_ROOM] = "", second[32] = "";
	const enum io_refusal why = *value ? spell_line(value, first, second) : IO_GOOD;

	if (why == IO_GOOD)
		set_place(draft, row, first, second);
	return why;
}

static void set_comment(struct draft *draft, const struct io_row *row, const char *value)
{
	const struct io_span *span = &row->comment;
	size_t at = span->len ? span->at - row->from : draft->len, keep = at;

	if (span->len)
		while (keep < span->at - row->from + span->len &&
		       (draft->text[keep] == '#' || draft->text[keep] == '/' ||
			is_blank(draft->text[keep])))
			keep++;
	if (!*value) {
		while (at > 0 && is_blank(draft->text[at - 1]))
			at--;
		splice(draft, at, draft->len - at, "");
	} else if (span->len) {
		splice(draft, keep, draft->len - keep, value);
		if (keep == at + 1)
			splice(draft, keep, 0, " ");
	} else {
		while (at > 0 && is_blank(draft->text[at - 1]))
			at--;
		splice(draft, at, draft->len - at, value);
		splice(draft, at, 0, "   # ");
	}
}

const char *const *io_text_choices(enum io_field field)
{
	static const char *const pull[] = { "pull-up", "pull-down", "no-pull", NULL };
	static const char *const drive[] = { "push-pull", "open-drain", "open-source",
					     NULL };
	static const char *const safe[] = { "0", "1", "hold", NULL };
	static const char *const substitute[] = { "0", "hold", NULL };
	static const char *const yes[] = { "1", NULL };
	static const char *const table[] = { "coil", "discrete-input", "input-register",
					     "holding-register", NULL };
	static const char *const order[] = { "big", "little", NULL };
	static const char *const parity[] = { "even", "odd", "none", NULL };
	static const char *const baud[] = { "9600", "19200", "38400", "57600", "115200", NULL };
	static const char *const bits[] = { "1", "2", NULL };
	static const char *const access[] = { "read-only", "read-write", NULL };
	static const char *const *const words[IO_FIELDS] = {
		[IO_PULL] = pull, [IO_DRIVE] = drive, [IO_SAFE] = safe,
		[IO_SUBSTITUTE] = substitute, [IO_ACTIVE_LOW] = yes, [IO_ON_CHANGE] = yes, [IO_TOGETHER] = yes,
		[IO_TABLE] = table, [IO_WORD_ORDER] = order, [IO_BYTE_ORDER] = order,
		[IO_PARITY] = parity, [IO_BAUD] = baud, [IO_STOP_BITS] = bits,
		[IO_ACCESS] = access,
	};

	return words[field];
}

static bool is_choice(const char *const *choices, const char *value)
{
	for (; choices && *choices; choices++)
		if (strcmp(*choices, value) == 0)
			return true;
	return !choices || !*value;
}

/* Whether the words of io_text_choices() are the only ones. The word itself says what it is for, or
 * it is a bit. */
static bool is_strict(const struct io_text *io, const struct io_row *row, enum io_field field)
{
	const struct io_span *address = &row->word[IO_WORD_ADDRESS];
	struct io_values values;

	if (field == IO_SAFE)
		return driver_of(io, row) & (ON_GPIO | ON_SIM | ON_OTHER) &&
		       io_values_read(io->text + address->at, address->len, &values) &&
		       values.first.bits == 1;
	return field == IO_PULL || field == IO_DRIVE || field == IO_TABLE || field == IO_ACCESS ||
	       io_field_is_flag(field);
}

static bool is_fixed(const struct io_row *row, enum io_word word)
{
	for (int i = 0; i < FIXED; i++)
		if (fixed_word(row->kind, i) == word)
			return true;
	return word == IO_WORD_SHOWN;
}

/* Options cannot stand before the words that a line begins with. */
static bool lacks_before(const struct io_row *row, enum io_field field)
{
	if (field == IO_COMMENT)
		return false;
	for (int i = 0; i < FIXED; i++) {
		const enum io_word word = fixed_word(row->kind, i);

		if (word == IO_WORDS || word == word_of(row, field))
			return false;
		if (!row->word[word].len)
			return true;
	}
	return false;
}

static enum io_refusal set_option(struct draft *draft, const struct io_row *row,
				  enum io_field field, const char *value)
{
	char word[NAME_ROOM + 24] = "";
	char before[24];

	put_before(word_of(row, field), io_field_is_flag(field), before, sizeof(before));
	if (strlen(value) > LIMIT_NAME)
		return IO_BAD_NAME;
	if (!*value && is_fixed(row, word_of(row, field)))
		return IO_EMPTY;
	if (*value && io_field_is_flag(field))
		snprintf(word, sizeof(word), "%s", before);
	else if (*value && is_name(row, field)) {
		snprintf(word, sizeof(word), "%s", before);
		if (!spell_typed(word + strlen(before), sizeof(word) - strlen(before), value,
				 strlen(value)))
			return IO_BAD_NAME;
	} else if (*value) {
		snprintf(word, sizeof(word), "%s%s", before, value);
	}
	if (*word && !is_one_word(word))
		return IO_MANY_WORDS;
	set_word(draft, row, word_of(row, field), word);
	return IO_GOOD;
}

/* One of several words: the one that is there is replaced; else @usual is added. */
static enum io_refusal set_named(struct draft *draft, const struct io_row *row,
				 const enum io_word *words, enum io_word usual,
				 const char *value)
{
	const enum io_word is = first_of(row, words);
	char word[NAME_ROOM + 24] = "";
	int used;

	if (strlen(value) > LIMIT_NAME)
		return IO_BAD_NAME;
	if (*value) {
		used = snprintf(word, sizeof(word), "%s=", option_name(usual));
		if (!spell_typed(word + used, sizeof(word) - (size_t)used, value, strlen(value)))
			return IO_BAD_NAME;
	}
	set_word(draft, row, is == IO_WORDS ? usual : is, word);
	return IO_GOOD;
}

/* The table of a new point: what is usual for its address. */
static enum io_word usual_table(const struct io_text *io, const struct io_row *row)
{
	const struct io_span *word = &row->word[word_of(row, IO_ADDRESS)];
	struct io_values values;
	bool output;

	if (!io_values_read(io->text + word->at, word->len, &values))
		return IO_WORD_HOLDING_REGISTER;
	output = row->kind == IO_KIND_WINDOW ||
		 iec_area_row(values.first.area)->access == ACCESS_WRITE;
	if (values.first.bits == 1)
		return output ? IO_WORD_COIL : IO_WORD_DISCRETE_INPUT;
	return output ? IO_WORD_HOLDING_REGISTER : IO_WORD_INPUT_REGISTER;
}

static enum io_refusal set_table(const struct io_text *io, struct draft *draft,
				 const struct io_row *row, const char *value)
{
	const enum io_word is = first_of(row, table_words);
	const struct io_span number = is == IO_WORDS ? (struct io_span){ 0, 0 } :
		value_of(io, &row->word[is]);
	enum io_word usual = IO_WORD_COIL;
	char word[NAME_ROOM + 24] = "";

	if (number.len > LIMIT_NAME)
		return IO_BAD_NAME;
	while (strcmp(option_name(usual), value) != 0 && usual < IO_WORD_HOLDING_REGISTER)
		usual++;
	if (*value)
		snprintf(word, sizeof(word), "%s=%.*s", value, number.len ? (int)number.len : 1,
			 number.len ? io->text + number.at : "0");
	set_word(draft, row, is == IO_WORDS ? usual : is, word);
	return IO_GOOD;
}

static enum io_refusal set_number(const struct io_text *io, struct draft *draft,
				  const struct io_row *row, const char *value)
{
	const enum io_word is = first_of(row, table_words);
	const enum io_word usual = is == IO_WORDS ? usual_table(io, row) : is;
	char word[LIMIT_NAME + 24] = "";

	if (strlen(value) > LIMIT_NAME)
		return IO_BAD_NAME;
	if (*value)
		snprintf(word, sizeof(word), "%s=%s", option_name(usual), value);
	if (*word && !is_one_word(word))
		return IO_MANY_WORDS;
	set_word(draft, row, usual, word);
	return IO_GOOD;
}

/* Splits "0..27648 at 0V..10V" into "range=0..27648" and "0V..10V". */
static enum io_refusal spell_range(const char *value, char *range, char *at, size_t room)
{
	const size_t len = strcspn(value, " \t");
	const char *rest = value + len + strspn(value + len, " \t");

	if (strlen(value) + 8 > room)
		return IO_BAD_NAME;
	snprintf(range, room, "range=%.*s", (int)len, value);
	at[0] = '\0';
	if (!is_one_word(range))
		return IO_MANY_WORDS;
	if (!*rest)
		return IO_GOOD;
	if (!ascii_is("at", rest, strcspn(rest, " \t")))
		return IO_MANY_WORDS;
	rest += 2;
	rest += strspn(rest, " \t");
	snprintf(at, room, "%s", rest);
	return is_one_word(at) ? IO_GOOD : IO_MANY_WORDS;
}

static enum io_refusal set_range(struct draft *draft, const struct io_row *row, const char *value)
{
	char range[LIMIT_NAME + 8] = "", at[LIMIT_NAME + 8] = "", whole[2 * LIMIT_NAME + 24];
	const bool has = row->word[IO_WORD_AT].len > 0;
	const enum io_refusal why = *value ? spell_range(value, range, at, sizeof(at)) : IO_GOOD;

	if (why != IO_GOOD)
		return why;
	if (has && row->word[IO_WORD_AT_VALUE].len) {
		set_word(draft, row, IO_WORD_AT_VALUE, at);
		if (!*at)
			set_word(draft, row, IO_WORD_AT, "");
		set_word(draft, row, IO_WORD_RANGE, range);
		return IO_GOOD;
	}
	if (has)
		set_word(draft, row, IO_WORD_AT, "");
	snprintf(whole, sizeof(whole), *at ? "%s at %s" : "%s", range, at);
	set_word(draft, row, IO_WORD_RANGE, whole);
	return IO_GOOD;
}

/* Words with blanks between them, none of them an option. */
static bool are_words(const char *text)
{
	struct lex lex;
	const char *end = text + strlen(text);

	lex_init(&lex, text, strlen(text));
	lex.newlines = lex.comments = true;
	for (lex_next(&lex); lex.token.kind != TOKEN_END; lex_next(&lex))
		if (lex.token.kind == TOKEN_NEWLINE || lex.token.kind == TOKEN_COMMENT ||
		    lex.token.kind == TOKEN_BAD || lex_is(&lex, "#") ||
		    memchr(lex.token.text, '=', lex.token.len))
			return false;
	return end > text && !is_blank(text[0]) && !is_blank(end[-1]);
}

static enum io_refusal set_names(struct draft *draft, const struct io_row *row, const char *value)
{
	if (*value && !are_words(value))
		return IO_BAD_NAME;
	set_word(draft, row, IO_WORD_NAMES, value);
	return IO_GOOD;
}

static enum io_word device_word(const struct io_text *io, const struct io_row *row)
{
	switch (driver_of(io, row)) {
	case ON_PWM: return IO_WORD_CHIP;
	case ON_W1: return IO_WORD_SENSOR;
	case ON_PEER: return IO_WORD_FROM;
	default: return IO_WORD_DEVICE;
	}
}

static enum io_refusal set_in(const struct io_text *io, struct draft *draft,
			      const struct io_row *row, enum io_field field, const char *value)
{
	switch ((int)field) {
	case IO_LINE:
		return set_line(draft, row, value);
	case IO_COMMENT:
		set_comment(draft, row, value);
		return IO_GOOD;
	case IO_DEVICE:
		return set_named(draft, row, device_words,
				 device_word(io, row), value);
	case IO_CHANNEL:
		return set_named(draft, row, channel_words,
				 driver_of(io, row) == ON_PEER ? IO_WORD_NAME : IO_WORD_CHANNEL, value);
	case IO_TABLE:
		return set_table(io, draft, row, value);
	case IO_NUMBER:
		return set_number(io, draft, row, value);
	case IO_RANGE:
		return set_range(draft, row, value);
	case IO_NAMES:
		return set_names(draft, row, value);
	default:
		return set_option(draft, row, field, value);
	}
}

/* The field has this value already, in whatever spelling. */
static bool is_now(const struct io_text *io, int number, enum io_field field, const char *value)
{
	char *now = io_text_field(io, number, field);
	const bool same = now && strcmp(now, value) == 0;

	free(now);
	return same;
}

enum io_refusal io_text_set(const struct io_text *io, int number, enum io_field field,
			    const char *value, struct io_edit *edit)
{
	const struct io_row *row = &io->row[number];
	enum io_refusal why;
	struct draft draft;

	*edit = (struct io_edit){ 0, 0, NULL };
	if (!io_text_has(io, number, field))
		return IO_NO_FIELD;
	if (lacks_before(row, field))
		return IO_EMPTY;
	if (has_control(value))
		return IO_BAD_NAME;
	if (is_strict(io, row, field) && !is_choice(io_text_choices(field), value))
		return IO_NO_WORD;
	if (!draft_open(&draft, io, row))
		return IO_MEMORY;
	why = is_now(io, number, field, value) ? IO_GOOD : set_in(io, &draft, row, field, value);
	if (why == IO_GOOD)
		return draft_close(&draft, io, row, edit);
	free(draft.text);
	return why;
}

/* ---- whole lines ---- */

static enum io_refusal put(struct io_edit *edit, size_t at, size_t removed,
			   const char *const *part, int count)
{
	size_t len = 1;

	for (int i = 0; i < count; i++)
		len += strlen(part[i]);
	*edit = (struct io_edit){ at, removed, malloc(len) };
	if (!edit->with)
		return IO_MEMORY;
	len = 0;
	for (int i = 0; i < count; i++) {
		const size_t more = strlen(part[i]);

		memcpy(edit->with + len, part[i], more + 1);
		len += more;
	}
	return IO_GOOD;
}

enum io_refusal io_text_set_board(const struct io_text *io, const char *name,
				  struct io_edit *edit)
{
	char quoted[NAME_ROOM] = "\"";
	const bool bom = io->len >= 3 && memcmp(io->text, "\xef\xbb\xbf", 3) == 0;
	size_t used = 1;

	*edit = (struct io_edit){ 0, 0, NULL };
	if (has_control(name) || strlen(name) > LIMIT_NAME)
		return IO_BAD_NAME;
	for (; *name; name++) {
		if (*name == '"' || *name == '$')
			quoted[used++] = '$';
		quoted[used++] = *name;
	}
	quoted[used] = '"';
	if (io->board.len)
		return put(edit, io->board.at, io->board.len,
			   (const char *[]){ quoted }, 1);
	if (io->board_line)
		return IO_NO_BOARD;
	return put(edit, bom ? 3 : 0, 0, (const char *[]){ "BOARD ", quoted, "\n" }, 3);
}

enum io_refusal io_text_delete(const struct io_text *io, int number, struct io_edit *edit)
{
	const struct io_row *row = &io->row[number];
	const bool whole = row->from == 0 || io->text[row->from - 1] == '\n';
	size_t end = row->end;

	while (whole && end < io->len && io->text[end] == '\r')
		end++;
	if (whole && end < io->len)
		end++; /* the newline */
	return put(edit, row->from, end - row->from, (const char *[]){ "" }, 1);
}

/* The start of the next line. */
static size_t behind_line(const struct io_text *io, size_t at)
{
	while (at < io->len && io->text[at] != '\n')
		at++;
	return at < io->len ? at + 1 : at;
}

/* Whether the row has its line for itself. */
static bool is_alone(const struct io_text *io, const struct io_row *row)
{
	return row->from == 0 || io->text[row->from - 1] == '\n';
}

static bool is_output(const char *address)
{
	struct io_values values;

	return io_values_read(address, strlen(address), &values) &&
	       iec_area_row(values.first.area)->access == ACCESS_WRITE;
}

enum io_refusal io_text_add(const struct io_text *io, int number, const char *first,
			    const char *second, const char *words, const char *comment,
			    struct io_edit *edit)
{
	const size_t at = number >= 0 ? behind_line(io, io->row[number].end) :
		number == IO_AT_START && io->count && is_alone(io, &io->row[0]) ? io->row[0].from :
		io->len;
	const bool open = at > 0 && io->text[at - 1] != '\n';
	const bool output = is_output(first) && !strstr(words, "safe=");

	*edit = (struct io_edit){ 0, 0, NULL };
	if (!is_one_word(first) || !is_one_word(second))
		return IO_MANY_WORDS;
	if (has_control(comment) || has_control(words))
		return IO_BAD_NAME;
	return put(edit, at, 0, (const char *[]){ open ? "\n" : "", first, "  ", second,
		*words ? "  " : "", words, output ? "  safe=0" : "", *comment ? "   # " : "",
		comment, "\n" }, 10);
}

/* Swaps two neighbouring pieces of the text, of whole lines; the newline that the last line may lack
 * stays missing. */
static enum io_refusal swap(const struct io_text *io, size_t at, size_t middle, size_t end,
			    struct io_edit *edit)
{
	const bool open = io->text[end - 1] != '\n';
	const size_t len = end - at;
	size_t used = 0;

	*edit = (struct io_edit){ at, len, malloc(len + 2) };
	if (!edit->with)
		return IO_MEMORY;
	memcpy(edit->with, io->text + middle, end - middle);
	used = end - middle;
	if (open)
		edit->with[used++] = '\n';
	memcpy(edit->with + used, io->text + at, middle - at);
	used += middle - at;
	edit->with[used - open] = '\0';
	return IO_GOOD;
}

enum io_refusal io_text_move(const struct io_text *io, int number, int target, bool behind,
			     struct io_edit *edit)
{
	const struct io_row *row = &io->row[number], *other = &io->row[target];
	const size_t end = behind_line(io, row->end);
	const size_t to = behind ? behind_line(io, other->end) : other->from;

	*edit = (struct io_edit){ 0, 0, NULL };
	if (!is_alone(io, row) || !is_alone(io, other))
		return IO_SHARED_LINE;
	if (to >= row->from && to <= end)
		return put(edit, row->from, 0, (const char *[]){ "" }, 1);
	return to < row->from ? swap(io, to, row->from, end, edit) :
				swap(io, row->from, end, to, edit);
}

/* ---- values ---- */

bool io_values_read(const char *text, size_t len, struct io_values *out)
{
	uint32_t bits;

	*out = (struct io_values){ .count = 0 };
	if (!iomap_group_read(text, len, &out->first, &bits))
		return false;
	out->count = bits / out->first.bits;
	return out->count > 0 && out->count <= LIMIT_IO_POINTS;
}

bool io_values_have(const struct io_values *values, struct iec_addr addr)
{
	const uint64_t from = 8 * (uint64_t)values->first.byte + values->first.bit;
	const uint64_t to = from + (uint64_t)values->count * values->first.bits;
	const uint64_t at = 8 * (uint64_t)addr.byte + addr.bit;

	return values->first.area == addr.area && at < to && from < at + addr.bits;
}
