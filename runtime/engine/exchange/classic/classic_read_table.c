/* SPDX-License-Identifier: MIT
 *
 * classic_read_table - blocks, expressions, sections, symbols, I/O lines, settings.
 *
 * Tables have two forms: with a letter and a number at the start of each line, or one line
 * for each number from 0.
 */
#include "engine/base/ascii.h"
#include "engine/exchange/classic/classic_read.h"

/* ---- blocks ---- */

/* @values: numbers of a line: 3: base, preset, mode; 2: base, preset; 1: preset, or the mode
 * of a register. */
void classic_add_block(struct classic_reader *reader, struct classic_blocks *blocks,
		       int number, const char *at, int values)
{
	struct classic_block block = { .number = number, .base = 1 }, *added;
	int value[3];

	block.place = classic_here(reader);
	if (!classic_numbers(reader, at, value, 1, values) ||
	    !classic_in_range(reader, number, 0, CLASSIC_LIMIT - 1))
		return;
	if (values > 1 && !classic_in_range(reader, value[0], 0, 2))
		return;
	if (values > 2 && !classic_in_range(reader, value[2], 0, 2))
		return;
	block.base = values > 1 ? value[0] : 1;
	block.preset = values > 1 ? value[1] : value[0];
	block.mode = values > 2 ? value[2] : 0;
	if (!classic_in_range(reader, block.preset, 0, CLASSIC_PRESET))
		return;
	added = arena_push(reader->arena, &blocks->block, &blocks->count, sizeof(block));
	if (added)
		*added = block;
}

void classic_read_blocks(struct classic_reader *reader, const struct classic_member *member,
			 struct classic_blocks *blocks, const char *letters, int values)
{
	int next = 0;

	classic_member_begin(reader, member);
	while (classic_line_told(reader)) {
		const char *end = reader->line + reader->len;
		const char *at = classic_line_after(reader, letters);
		int number;

		if (*reader->line == '#') {
			classic_version(reader, 2);
		} else if (ascii_digit(*reader->line) || *reader->line == '-') {
			classic_add_block(reader, blocks, next++, reader->line, values);
		} else if (!at || !classic_number(&at, end, &number) || at == end ||
			   *at != ',') {
			classic_fail(reader, DIAG_IMPORT_LINE, reader->line, reader->len);
		} else {
			classic_add_block(reader, blocks, number, at + 1, values);
		}
	}
}

/* ---- expressions ---- */

static void add_expression(struct classic_reader *reader, int number, const char *at)
{
	struct classic_project *project = reader->project;
	size_t len = (size_t)(reader->line + reader->len - at);
	struct classic_expression *added;

	if (!len || (len == 1 && *at == '#') ||
	    !classic_in_range(reader, number, 0, CLASSIC_LIMIT - 1))
		return;
	if (len > 49)
		classic_fail(reader, DIAG_IMPORT_LONG, at, len);
	added = arena_push(reader->arena, &project->expression, &project->expressions,
			   sizeof(*added));
	if (added)
		*added = (struct classic_expression){
			.number = number, .place = classic_here(reader),
			.text = classic_text(reader, at, len) };
}

/* "NNNN,TEXT"; before #VER=2.0 one line for each number, empty ones count. */
void classic_read_expressions(struct classic_reader *reader,
			      const struct classic_member *member)
{
	bool numbered = false;
	int next = 0;

	classic_member_begin(reader, member);
	while (classic_line_next(reader)) {
		const char *at = reader->line;
		int number;

		if (reader->len && *at == ';')
			continue;
		if (classic_line_after(reader, "#VER=")) {
			classic_version(reader, 2);
			numbered = true;
		} else if (!numbered) {
			add_expression(reader, next++, at);
		} else if (reader->len && *at != '#') {
			if (!classic_number(&at, at + reader->len, &number) ||
			    at == reader->line + reader->len || *at != ',')
				classic_fail(reader, DIAG_IMPORT_FIELDS, reader->line,
					     reader->len);
			else
				add_expression(reader, number, at + 1);
		}
	}
}

/* ---- sections ---- */

static struct classic_section *find_section(struct classic_project *project, int number)
{
	for (int i = 0; i < project->sections; i++)
		if (project->section[i].number == number)
			return &project->section[i];
	return NULL;
}

/* Gives each line that is no directive to @add. */
static void read_lines(struct classic_reader *reader, const struct classic_member *member,
		       void (*add)(struct classic_reader *reader))
{
	classic_member_begin(reader, member);
	while (classic_line_told(reader)) {
		if (*reader->line == '#')
			classic_version(reader, 1);
		else
			add(reader);
	}
}

static void add_section(struct classic_reader *reader)
{
	struct classic_project *project = reader->project;
	struct classic_section *added;
	int value[6];

	if (!classic_numbers(reader, reader->line, value, 3, 6) ||
	    !classic_in_range(reader, value[0], 0, 999) ||
	    !classic_in_range(reader, value[1], 0, 1) ||
	    !classic_in_range(reader, value[2], -1, CLASSIC_LIMIT - 1) ||
	    !classic_in_range(reader, value[5], 0, CLASSIC_LIMIT - 1))
		return;
	if (!value[1] && (!classic_in_range(reader, value[3], -1, CLASSIC_LIMIT - 1) ||
			  !classic_in_range(reader, value[4], -1, CLASSIC_LIMIT - 1)))
		return;
	if (find_section(project, value[0])) {
		classic_twice(reader, classic_here(reader), "section", value[0]);
		return;
	}
	added = arena_push(reader->arena, &project->section, &project->sections,
			   sizeof(*added));
	if (added)
		*added = (struct classic_section){
			.number = value[0], .place = classic_here(reader), .name = "",
			.sequential = value[1], .subroutine = value[2],
			.first = value[3], .last = value[4], .page = value[5] };
}

/* Names stand before their sections, so they are read in a second pass. */
static void name_section(struct classic_reader *reader)
{
	const char *end = reader->line + reader->len;
	const char *at = classic_line_after(reader, "#NAME");
	struct classic_section *section;
	int number;

	if (!at)
		return;
	if (!classic_number(&at, end, &number) || at == end || *at != '=') {
		classic_fail(reader, DIAG_IMPORT_FIELDS, reader->line, reader->len);
		return;
	}
	section = find_section(reader->project, number);
	at++;
	if (section)
		section->name = classic_name(reader, at, (size_t)(end - at), 19);
}

void classic_read_sections(struct classic_reader *reader,
			   const struct classic_member *member)
{
	read_lines(reader, member, add_section);
	classic_member_begin(reader, member);
	while (classic_line_told(reader))
		if (*reader->line == '#')
			name_section(reader);
}

/* ---- symbols ---- */

/* The text up to the next comma or the end; steps over the comma. */
static const char *take_field(struct classic_reader *reader, const char **at, size_t *len)
{
	const char *end = reader->line + reader->len, *from = *at;
	const char *comma = from < end ? memchr(from, ',', (size_t)(end - from)) : NULL;

	*len = (size_t)((comma ? comma : end) - from);
	*at = comma ? comma + 1 : end;
	return from;
}

static void add_symbol(struct classic_reader *reader)
{
	struct classic_project *project = reader->project;
	struct classic_symbol symbol = { .place = classic_here(reader) }, *added;
	const char *at = reader->line, *end = at + reader->len, *from;
	size_t len;

	from = take_field(reader, &at, &len);
	symbol.variable = classic_name(reader, from, len, 0);
	from = take_field(reader, &at, &len);
	symbol.name = classic_name(reader, from, len, 0);
	from = take_field(reader, &at, &len);
	symbol.comment = classic_text(reader, from, len);
	if (at < end)
		classic_fail(reader, DIAG_IMPORT_COMMA, reader->line, reader->len);
	if (*symbol.variable != '%')
		classic_fail(reader, DIAG_IMPORT_LINE, reader->line, reader->len);
	added = arena_push(reader->arena, &project->symbol, &project->symbols,
			   sizeof(symbol));
	if (added)
		*added = symbol;
}

void classic_read_symbols(struct classic_reader *reader,
			  const struct classic_member *member)
{
	read_lines(reader, member, add_symbol);
}

/* ---- lines of the machine ---- */

/* LinuxCNC writes lines of six numbers that it does not use. */
static void add_io(struct classic_reader *reader)
{
	struct classic_project *project = reader->project;
	struct classic_io *added;
	int value[8], commas = 0;

	for (size_t i = 0; i < reader->len; i++)
		commas += reader->line[i] == ',';
	if (!classic_numbers(reader, reader->line, value, 1, 8))
		return;
	if (commas < 6)
		return;
	if (!classic_in_range(reader, value[0], 0, 1) ||
	    !classic_in_range(reader, value[1], -1, CLASSIC_LIMIT - 1) ||
	    !classic_in_range(reader, value[5], 0, CLASSIC_LIMIT - 1) ||
	    !classic_in_range(reader, value[6], 0, 1))
		return;
	added = arena_push(reader->arena, &project->io, &project->ios, sizeof(*added));
	if (added)
		*added = (struct classic_io){
			.place = classic_here(reader), .output = value[0],
			.first = value[1], .device = value[2], .sub_device = value[3],
			.channel = value[4], .count = value[5], .inverted = value[6],
			.setup = value[7] };
}

void classic_read_io(struct classic_reader *reader, const struct classic_member *member)
{
	read_lines(reader, member, add_io);
}

/* ---- settings ---- */

static bool read_setting(struct classic_reader *reader, const char *key, int low, int high,
			 int *value)
{
	const char *end = reader->line + reader->len;
	const char *at = classic_line_after(reader, key);
	int number;

	if (!at || at == end)
		return false;
	if (!classic_number(&at, end, &number))
		return classic_fail(reader, DIAG_IMPORT_FIELDS, reader->line, reader->len);
	if (classic_in_range(reader, number, low, high))
		*value = number;
	return true;
}

void classic_read_settings(struct classic_reader *reader,
			   const struct classic_member *member)
{
	struct classic_project *project = reader->project;

	classic_member_begin(reader, member);
	while (classic_line_told(reader)) {
		const char *end = reader->line + reader->len;
		const char *equals = memchr(reader->line, '=', reader->len);
		struct classic_setting *added;

		if (!equals) {
			if (*reader->line != '#')
				classic_lost(reader, "a line without =");
			continue;
		}
		read_setting(reader, "PERIODIC_REFRESH=", 0, CLASSIC_PERIOD,
			     &project->period);
		project->period = project->period ? project->period : CLASSIC_USUAL_PERIOD;
		read_setting(reader, "SIZE_REGISTER_LIST=", 0, CLASSIC_LIMIT,
			     &project->register_list);
		added = arena_push(reader->arena, &project->setting, &project->settings,
				   sizeof(*added));
		if (added)
			*added = (struct classic_setting){
				classic_here(reader),
				classic_text(reader, reader->line,
					     (size_t)(equals - reader->line)),
				classic_text(reader, equals + 1,
					     (size_t)(end - equals - 1)) };
	}
}
