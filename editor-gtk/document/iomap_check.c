/* SPDX-License-Identifier: MIT
 *
 * iomap_check - errors of an I/O map by line, and the lines of this machine.
 *
 * A map with one error has no points. To judge the others too, lines with errors are
 * blanked in a copy until it can be read.
 */
#include "editor-gtk/document/iomap_check.h"

#include "editor-gtk/document/iomap_text.h"

#include "hal/hal.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* ---- this machine ---- */

static const char *keep(struct arena *arena, const char *text)
{
	const char *kept = arena_copy(arena, text, strlen(text));

	return kept ? kept : "";
}

static void add_line(void *context, const struct line_seen *seen)
{
	struct io_machine *machine = context;
	struct io_found *line = arena_push(&machine->arena, &machine->line,
					   &machine->count, sizeof(*line));

	if (!line)
		return;
	line->chip = keep(&machine->arena, seen->chip);
	line->label = keep(&machine->arena, seen->label);
	line->name = keep(&machine->arena, seen->name);
	line->owner = keep(&machine->arena, seen->owner);
	line->offset = seen->offset;
	line->used = seen->used;
	line->output = seen->output;
}

void io_machine_look(struct io_machine *out, const char *dev)
{
	arena_init(&out->arena);
	diag_init(&out->diags);
	out->line = NULL;
	out->count = 0;
	out->elsewhere = false;
	hal_list(dev, add_line, out, &out->diags);
}

void io_machine_free(struct io_machine *machine)
{
	arena_free(&machine->arena);
	machine->line = NULL;
	machine->count = 0;
}

static bool is_unique(const struct io_machine *machine, int line)
{
	for (int i = 0; i < machine->count; i++)
		if (i != line && strcmp(machine->line[i].name,
					machine->line[line].name) == 0)
			return false;
	return *machine->line[line].name;
}

int io_machine_name(const struct io_machine *machine, int line, char *out, size_t size)
{
	const struct io_found *found = &machine->line[line];

	if (!is_unique(machine, line))
		return snprintf(out, size, strchr(found->label, ' ') ? "\"%s\" %u" :
				"%s %u", found->label, (unsigned)found->offset);
	if (strchr(found->name, ' '))
		return snprintf(out, size, "\"%s\"", found->name);
	return snprintf(out, size, "%s", found->name);
}

/* ---- reading, also of a map with errors ---- */

static void blank_line(char *text, size_t len, int line)
{
	size_t at = 0;

	for (int i = 1; i < line && at < len; at++)
		i += text[at] == '\n';
	for (; at < len && text[at] != '\n'; at++)
		text[at] = ' ';
}

/* The copy begins with a board's name, so that a map without one has points; its lines
 * count from 2. */
static char *copy_of(const char *text, size_t len, size_t *out_len)
{
	static const char board[] = "BOARD \"-\"\n";
	const size_t before = sizeof(board) - 1;
	const bool bom = len >= 3 && memcmp(text, "\xef\xbb\xbf", 3) == 0;
	char *copy = malloc(before + len + 1);
	struct io_text io;

	if (!copy)
		return NULL;
	memcpy(copy, board, before);
	memcpy(copy + before, text, len);
	if (bom)
		memset(copy + before, ' ', 3);
	if (io_text_read(&io, text, len) && io.board_line)
		blank_line(copy, before + len, io.board_line + 1);
	io_text_free(&io);
	*out_len = before + len;
	return copy;
}

/* False: the error belongs to no line. */
static bool blank_bad_lines(char *text, size_t len, const struct diag_list *diags)
{
	bool any = false;

	for (int i = 0; i < diags->count; i++)
		if (diags->diag[i].line > 1) {
			blank_line(text, len, diags->diag[i].line);
			any = true;
		}
	return any;
}

/* Bounds the number of times a text is read. */
#define ROUNDS 20

static void read_good(struct io_check *check, const char *text, size_t len)
{
	struct diag_list *diags = malloc(sizeof(*diags));
	size_t copy_len;
	char *copy = copy_of(text, len, &copy_len);

	for (int round = 0; diags && copy && round < ROUNDS; round++) {
		diag_init(diags);
		if (iomap_read(&check->map, &check->arena, "", copy, copy_len, diags) ||
		    !blank_bad_lines(copy, copy_len, diags))
			break;
	}
	for (int i = 0; i < check->map.count; i++)
		check->map.point[i].text_line--;
	free(copy);
	free(diags);
}

/* ---- where the lines are ---- */

static int find_line(const struct io_machine *machine, struct line_at at)
{
	char chip[32];

	snprintf(chip, sizeof(chip), "gpiochip%d", at.chip);
	for (int i = 0; i < machine->count; i++)
		if (machine->line[i].offset == at.offset &&
		    strcmp(machine->line[i].chip, chip) == 0)
			return i;
	return -1;
}

/* Reports a pin that an earlier line has under another name. */
static void check_twice(struct io_check *check, int index)
{
	const struct io_placed *placed = &check->placed[index];

	for (int i = 0; i < index; i++) {
		char name[LIMIT_ARG], first[24];

		if (check->placed[i].found != placed->found)
			continue;
		io_line_print(placed->point, name, sizeof(name));
		iec_addr_print(check->placed[i].point->addr, first, sizeof(first));
		diag_add(&check->here, io_place(&check->map, placed->point,
			check->placed[i].point->output == placed->point->output ?
			DIAG_IO_LINE_TWICE : DIAG_IO_BOTH_WAYS),
			"%s" DIAG_AND "%s", name, first);
		return;
	}
}

static bool has_chip(const struct io_found *line, const char *chip)
{
	const char *name = strncmp(chip, "/dev/", 5) == 0 ? chip + 5 : chip;

	return strcmp(line->chip, name) == 0 || strcmp(line->label, chip) == 0;
}

/* The line of a point among those of a board, which cannot be asked as this machine can. */
static int find_elsewhere(const struct io_machine *machine, const struct io_point *point, enum diag_id *why)
{
	*why = point->line ? DIAG_IO_NO_LINE : DIAG_IO_NO_CHIP;
	for (int i = 0; i < machine->count; i++) {
		const struct io_found *line = &machine->line[i];

		if (point->line ? strcmp(line->name, point->line) == 0 :
		    has_chip(line, point->chip) && line->offset == point->offset)
			return i;
	}
	return -1;
}

static void place_elsewhere(struct io_check *check, int index, const struct io_machine *machine)
{
	struct io_placed *placed = &check->placed[index];
	enum diag_id why;

	if (placed->point->driver != DRIVER_gpio)
		return;
	placed->found = find_elsewhere(machine, placed->point, &why);
	if (placed->found >= 0)
		check_twice(check, index);
	else
		diag_add(&check->here, io_place(&check->map, placed->point, why), "%s",
			 placed->point->line ? placed->point->line : placed->point->chip);
}

static void place(struct io_check *check, int index, const struct io_machine *machine,
		  const char *dev)
{
	struct io_placed *placed = &check->placed[index];
	const struct driver *driver = driver_row(placed->point->driver);
	struct trouble why;
	struct line_at at;

	if (machine && machine->elsewhere) {
		place_elsewhere(check, index, machine);
		return;
	}
	if (!driver->open && !driver->by_channel)
		diag_add(&check->here, io_place(&check->map, placed->point,
						DIAG_IO_NO_DRIVER), "%s", driver->word);
	if (!machine || !machine->count || !driver->find)
		return;
	if (!driver->find(placed->point, dev ? dev : "/dev", &at, &why)) {
		diag_add(&check->here, io_place(&check->map, placed->point, why.id), "%s",
			 why.text);
		return;
	}
	placed->found = find_line(machine, at);
	if (placed->found >= 0)
		check_twice(check, index);
}

static const struct diag *diag_at(const struct diag_list *list, int line)
{
	for (int i = 0; i < list->count; i++)
		if (list->diag[i].line == line)
			return &list->diag[i];
	return NULL;
}

/* A safe value belongs to each output, so each line without one gets a warning. */
static void check_safe(struct io_check *check, const struct io_point *point)
{
	char address[24];

	if (!point->output || point->has_safe || diag_at(&check->doubts, point->text_line))
		return;
	iec_addr_print(point->addr, address, sizeof(address));
	diag_add(&check->doubts, io_place(&check->map, point, DIAG_IO_NO_SAFE), "%s", address);
}

struct io_check *io_check_new(const char *text, size_t len, const struct areas *areas,
			      const struct io_machine *machine, const char *dev)
{
	struct io_check *check = calloc(1, sizeof(*check));

	if (!check)
		return NULL;
	arena_init(&check->arena);
	diag_init(&check->errors);
	diag_init(&check->doubts);
	diag_init(&check->here);
	if (!iomap_read(&check->map, &check->arena, "", text, len, &check->errors))
		read_good(check, text, len);
	iomap_fits(&check->map, areas, &check->errors);
	check->placed = calloc((size_t)check->map.count + 1, sizeof(*check->placed));
	if (!check->placed) {
		io_check_free(check);
		return NULL;
	}
	for (int i = 0; i < check->map.count; i++) {
		check->placed[i] = (struct io_placed){ &check->map.point[i], -1 };
		check_safe(check, check->placed[i].point);
		place(check, i, machine, dev);
	}
	return check;
}

void io_check_free(struct io_check *check)
{
	if (!check)
		return;
	arena_free(&check->arena);
	free(check->placed);
	free(check);
}

const struct diag *io_check_at(const struct io_check *check, int line, bool *warns)
{
	const struct diag *said = diag_at(&check->errors, line);

	*warns = !said;
	if (!said)
		said = diag_at(&check->doubts, line);
	return said ? said : diag_at(&check->here, line);
}

const struct io_placed *io_check_point(const struct io_check *check, int line)
{
	for (int i = 0; i < check->map.count; i++)
		if (check->placed[i].point->text_line == line)
			return &check->placed[i];
	return NULL;
}

bool io_check_has(const struct io_check *check, struct iec_addr addr)
{
	for (int i = 0; i < check->map.count; i++) {
		const struct io_values one = { check->map.point[i].addr, 1 };

		if (io_values_have(&one, addr))
			return true;
	}
	return false;
}
