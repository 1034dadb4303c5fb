/* SPDX-License-Identifier: MIT
 *
 * picture - joins the kernel's state of a line, the point of the map that names it, and
 * the variable at its address.
 */
#include "ladder/picture.h"

#include "hal/hal.h"
#include "ladder/screen.h"
#include "ladder/tty.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static bool keep(struct picture *picture, const char **out, const char *text)
{
	*out = arena_copy(&picture->arena, text, strlen(text));
	return *out != NULL;
}

static void add_line(void *context, const struct line_seen *seen)
{
	struct picture *picture = context;
	struct picture_line *line =
		arena_push(&picture->arena, &picture->line, &picture->count,
			   sizeof(*line));

	if (!line)
		return;
	line->offset = seen->offset;
	line->used = seen->used;
	line->output = seen->output;
	line->active_low = seen->active_low;
	line->bias = seen->bias;
	line->level = LEVEL_UNKNOWN;
	if (!keep(picture, &line->chip, seen->chip) ||
	    !keep(picture, &line->label, seen->label) ||
	    !keep(picture, &line->name, seen->name) ||
	    !keep(picture, &line->owner, seen->owner))
		picture->count--;
}

/* ---- levels ---- */

/*
 * The level of a line cannot be read without requesting the line. For lines that are in use
 * the kernel prints it in its debugfs, to root only. A chip is
 *   gpiochip0: GPIOs 512-565, parent: platform/…
 * (newer kernels count from 0: `gpiochip0: 54 GPIOs, …`), and below it a line in use, with
 * the number of the first line added, is
 *    gpio-529 (GPIO17              |ladderd             ) in  hi ACTIVE LOW
 * Other forms are skipped; their level stays unknown.
 */
#define LEVELS_FILE "/sys/kernel/debug/gpio"

struct chip_seen {
	char name[24];
	uint32_t first;
	bool good;
};

static bool read_number(const char **at, uint32_t *out)
{
	char *end;
	unsigned long number;

	if (**at < '0' || **at > '9')
		return false;
	number = strtoul(*at, &end, 10);
	*at = end;
	*out = (uint32_t)number;
	return number <= 1000000;
}

static void read_chip(const char *line, struct chip_seen *chip)
{
	size_t len = strcspn(line, ":");
	const char *at = line + len;
	uint32_t count;

	chip->good = false;
	if (len >= sizeof(chip->name) || *at != ':')
		return;
	memcpy(chip->name, line, len);
	chip->name[len] = '\0';
	chip->first = 0;
	if (!strncmp(at, ": GPIOs ", 8)) {
		at += 8;
		chip->good = read_number(&at, &chip->first) && *at == '-';
	} else if (!strncmp(at, ": ", 2)) {
		at += 2;
		chip->good = read_number(&at, &count) &&
			     !strncmp(at, " GPIOs", 6);
	}
}

/* The level is after the last bracket; names may contain brackets. */
static enum level read_level(const char *line)
{
	const char *at = strrchr(line, ')');

	if (!at)
		return LEVEL_UNKNOWN;
	at++;
	at += strspn(at, " ");
	if (!strncmp(at, "output-", 7)) /* as gpio-sim writes it          */
		at += 7;
	else if (!strncmp(at, "in ", 3) || !strncmp(at, "out ", 4))
		at += strcspn(at, " ");
	else
		return LEVEL_UNKNOWN;
	at += strspn(at, " ");
	if (!strncmp(at, "hi", 2))
		return LEVEL_HIGH;
	return !strncmp(at, "lo", 2) ? LEVEL_LOW : LEVEL_UNKNOWN;
}

static void set_level(struct picture *picture, const char *chip, uint32_t offset,
		      enum level level)
{
	for (int i = 0; i < picture->count; i++)
		if (picture->line[i].offset == offset &&
		    !strcmp(picture->line[i].chip, chip))
			picture->line[i].level = level;
}

/* False: the file cannot be read. */
static bool read_levels(struct picture *picture)
{
	struct chip_seen chip = { .good = false };
	FILE *file = fopen(LEVELS_FILE, "r");
	char line[512];

	if (!file)
		return false;
	while (fgets(line, sizeof(line), file)) {
		const char *at = line + strspn(line, " ");
		enum level level = read_level(line);
		uint32_t number;

		if (!strncmp(line, "gpiochip", 8)) {
			read_chip(line, &chip);
			continue;
		}
		if (!chip.good || strncmp(at, "gpio-", 5) != 0)
			continue;
		at += 5;
		if (read_number(&at, &number) && number >= chip.first &&
		    level != LEVEL_UNKNOWN)
			set_level(picture, chip.name, number - chip.first, level);
	}
	fclose(file);
	return true;
}

/* ---- the picture ---- */

bool picture_take(struct picture *picture, struct diag_list *diags)
{
	bool good;

	arena_init(&picture->arena);
	picture->line = NULL;
	picture->count = 0;
	good = hal_list(NULL, add_line, picture, diags);
	picture->levels = read_levels(picture);
	return good;
}

void picture_free(struct picture *picture)
{
	arena_free(&picture->arena);
	picture->line = NULL;
	picture->count = 0;
}

int picture_rows(const struct picture *picture)
{
	return picture->map ? picture->map->count : picture->count;
}

/* On Raspberry Pi OS "gpiochip4" is a link to another number. */
static bool is_chip(const char *wanted, const struct picture_line *line)
{
	const char *name = !strncmp(wanted, "/dev/", 5) ? wanted + 5 : wanted;
	char path[80], target[80];
	const char *last;
	ssize_t len;

	if (!strcmp(wanted, line->label) || !strcmp(name, line->chip))
		return true;
	if (strncmp(name, "gpiochip", 8) != 0)
		return false;
	snprintf(path, sizeof(path), "/dev/%.60s", name);
	len = readlink(path, target, sizeof(target) - 1);
	if (len < 0)
		return false;
	target[len] = '\0';
	last = strrchr(target, '/');
	return !strcmp(last ? last + 1 : target, line->chip);
}

static const struct io_point *point_of(const struct picture *picture, int row)
{
	return picture->map ? &picture->map->point[row] : NULL;
}

/* NULL: this machine has no such line, or the line is simulated. */
static const struct picture_line *line_of(const struct picture *picture,
					  int row)
{
	const struct io_point *point = point_of(picture, row);

	if (!point)
		return &picture->line[row];
	if (!driver_row(point->driver)->needs_line)
		return NULL;
	for (int i = 0; i < picture->count; i++) {
		const struct picture_line *line = &picture->line[i];

		if (point->line ? !strcmp(point->line, line->name) :
				  point->offset == line->offset &&
					  is_chip(point->chip, line))
			return line;
	}
	return NULL;
}

bool picture_is_whole(const struct picture *picture)
{
	for (int i = 0; picture->map && i < picture->map->count; i++)
		if (driver_row(picture->map->point[i].driver)->needs_line &&
		    !line_of(picture, i))
			return false;
	return true;
}

static enum level picture_level(const struct picture *picture, int row)
{
	const struct picture_line *line = line_of(picture, row);

	return line ? line->level : LEVEL_UNKNOWN;
}

#define NAME_ROOM (LIMIT_NAME + 16)

/* Which element of a variable is at an address, 0 if it is no array; UINT32_MAX: none. Bits count from the
 * start of their area, other values are at a byte of the memory. */
static uint32_t element_at(const struct program *program, struct iec_addr addr,
			   const struct declared_name *name)
{
	const bool bit = name->at.type == IEC_BOOL && name->at.area;
	const uint32_t size = iec_type_row(name->at.type)->size;
	const uint32_t at = bit ? addr.byte * 8 + addr.bit : areas_byte(&program->areas, addr);
	const uint32_t step = bit ? 1 : name->stride ? name->stride : size;

	if (bit ? name->at.area != addr.area || addr.bits != 1 :
		  name->at.area != AREA_NONE || !size || 8 * size != addr.bits)
		return UINT32_MAX;
	if (at < name->at.where || (at - name->at.where) % step)
		return UINT32_MAX;
	return (at - name->at.where) / step;
}

/* The variable at an address, "" if there is none. The name of an array element is written
 * to @room. */
static const char *variable_at(const struct picture *picture,
			       struct iec_addr addr, char room[NAME_ROOM])
{
	struct declared_cursor cursor = { 0 };
	struct declared_name name;

	while (picture->program &&
	       image_next_declared(picture->program, &cursor, &name)) {
		const uint32_t count = name.array.count ? name.array.count : 1;
		const uint32_t number = name.at.type == IEC_NONE ? count :
			element_at(picture->program, addr, &name);

		if (number >= count)
			continue;
		if (!name.array.count)
			return name.name;
		snprintf(room, NAME_ROOM, "%.*s[%lld]", (int)name.array.head,
			 name.name, (long long)name.array.low + number);
		return room;
	}
	return "";
}

static const char *bias_word(enum io_bias bias)
{
	static const char *const word[] = {
		[BIAS_AS_IS] = "", [BIAS_NONE] = "no-pull",
		[BIAS_UP] = "pull-up", [BIAS_DOWN] = "pull-down",
	};

	return word[bias];
}

static const char *owner_of(const struct picture_line *line)
{
	return !line->used ? "free" : *line->owner ? line->owner : "in use";
}

/* A cell of a table: at least @width columns and a blank. */
static void cell(const struct sink *out, const char *text, int width)
{
	sink_text(out, *text ? text : "-");
	sink_repeat(out, " ", width - (int)(*text ? strlen(text) : 1));
	sink_text(out, " ");
}

static void line_cells(const struct picture_line *line, const struct sink *out)
{
	static const char *const level[] = {
		[LEVEL_UNKNOWN] = "", [LEVEL_LOW] = "low",
		[LEVEL_HIGH] = "high",
	};
	char text[40];

	cell(out, line->chip, 10);
	snprintf(text, sizeof(text), "%4u", (unsigned)line->offset);
	cell(out, text, 6);
	cell(out, line->output ? "output" : "input", 6);
	cell(out, level[line->level], 5);
	snprintf(text, sizeof(text), "%s%s%s", bias_word(line->bias),
		 line->active_low && line->bias ? " " : "",
		 line->active_low ? "active-low" : "");
	cell(out, text, 10);
	sink_text(out, owner_of(line));
}

void picture_head(const struct picture *picture, const struct sink *out)
{
	if (picture->map) {
		cell(out, "address", 8);
		cell(out, "variable", 16);
		cell(out, "line", 20);
	} else {
		cell(out, "line", 24);
		cell(out, "label", 20);
	}
	sink_text(out, "chip       offset now    level bias       owner");
}

void picture_row(const struct picture *picture, int row,
		 const struct sink *out)
{
	const struct io_point *point = point_of(picture, row);
	const struct picture_line *line = line_of(picture, row);
	char text[80], name[NAME_ROOM];

	if (!point) {
		cell(out, line->name, 24);
		cell(out, line->label, 20);
		line_cells(line, out);
		return;
	}
	iec_addr_print(point->addr, text, sizeof(text));
	cell(out, text, 8);
	cell(out, variable_at(picture, point->addr, name), 16);
	io_line_print(point, text, sizeof(text));
	cell(out, point->line || point->chip || driver_row(point->driver)->by_channel ? text : "", 20);
	if (line)
		line_cells(line, out);
	else
		sink_text(out, driver_row(point->driver)->needs_line ?
				       "not on this machine" :
			       point->driver == DRIVER_sim ? "simulated" :
							     driver_row(point->driver)->word);
}

static void json_line(const struct picture_line *line, const struct sink *out)
{
	sink_text(out, "\"chip\": ");
	sink_json_text(out, line->chip);
	report_json_field("label", line->label, out);
	sink_printf(out, ", \"offset\": %u", (unsigned)line->offset);
	report_json_field("name", line->name, out);
	report_json_field("owner", line->owner, out);
	sink_printf(out, ", \"used\": %s, \"output\": %s, \"active_low\": %s",
		    line->used ? "true" : "false",
		    line->output ? "true" : "false",
		    line->active_low ? "true" : "false");
	report_json_field("bias", line->bias == BIAS_AS_IS ? NULL : bias_word(line->bias),
			  out);
	sink_printf(out, ", \"level\": %s",
		    line->level == LEVEL_UNKNOWN ? "null" :
		    line->level == LEVEL_HIGH ? "1" : "0");
}

void picture_json(const struct picture *picture, int row,
		  const struct sink *out)
{
	const struct io_point *point = point_of(picture, row);
	const struct picture_line *line = line_of(picture, row);
	const char *variable;
	char text[80], name[NAME_ROOM];

	sink_text(out, "{");
	if (point) {
		variable = variable_at(picture, point->addr, name);
		iec_addr_print(point->addr, text, sizeof(text));
		sink_text(out, "\"address\": ");
		sink_json_text(out, text);
		report_json_field("variable", *variable ? variable : NULL, out);
		report_json_field("driver", driver_row(point->driver)->word, out);
		io_line_print(point, text, sizeof(text));
		report_json_field("line", text, out);
		sink_text(out, ", \"here\": ");
	}
	if (point && !line)
		sink_text(out, "null");
	else if (point)
		sink_text(out, "{");
	if (line)
		json_line(line, out);
	sink_text(out, point && line ? "}}" : "}");
}

#define FRAME_NS 250000000 /* 4 pictures a second                           */

struct view {
	struct picture *picture;
	struct screen screen;
	struct sink_memory text; /* of one row                             */
	const char *title;
	int first, page;         /* row at the top; rows that were shown   */
	bool whole;              /* every chip could be read               */
};

static void put_row(struct view *view, int row)
{
	struct sink out = sink_to_memory(&view->text);

	view->text.len = 0;
	picture_row(view->picture, row, &out);
	screen_put(&view->screen,
		   picture_level(view->picture, row) == LEVEL_HIGH ?
			   STYLE_GOOD : STYLE_PLAIN,
		   sink_memory_text(&view->text));
}

static void put_foot(struct view *view, int rows, int shown)
{
	char text[96];

	if (view->first || shown < rows) {
		snprintf(text, sizeof(text), " %d to %d of %d; space: next page, ",
			 rows ? view->first + 1 : 0, view->first + shown, rows);
		screen_put(&view->screen, STYLE_DIM, text);
	}
	screen_put(&view->screen, STYLE_DIM, " q: quit");
	if (!view->whole)
		screen_put(&view->screen, STYLE_BAD,
			   "  a chip cannot be read: see `ladder io`");
	else if (!view->picture->levels)
		screen_put(&view->screen, STYLE_DIM,
			   "  levels: not told here (they need root and debugfs)");
}

static bool draw(struct view *view)
{
	struct screen *screen = &view->screen;
	int rows = picture_rows(view->picture), width, height, shown = 0;
	struct sink out = sink_to_memory(&view->text);

	tty_size(&width, &height);
	if (view->first >= rows)
		view->first = 0;
	screen_begin(screen, width, height);
	screen_put(screen, STYLE_TITLE, " Rungboard ");
	screen_put(screen, STYLE_TITLE, view->title);
	screen_put(screen, STYLE_TITLE, " ");
	if (screen_line(screen)) {
		view->text.len = 0;
		picture_head(view->picture, &out);
		screen_put(screen, STYLE_BOLD, sink_memory_text(&view->text));
		while (view->first + shown < rows && screen->row + 2 < height &&
		       screen_line(screen))
			put_row(view, view->first + shown++);
		if (screen_line(screen))
			put_foot(view, rows, shown);
	}
	screen_end(screen);
	view->page = shown ? shown : 1;
	return tty_draw(sink_memory_text(&screen->frame), screen->frame.len);
}

/* False: quit. */
static bool take_key(struct view *view, int key)
{
	if (key == 'q' || key == 'Q' || key == -2)
		return false;
	if (key == ' ')
		view->first += view->page;
	return true;
}

static bool take(struct view *view)
{
	struct diag_list *diags = report_list(view->title);

	if (!diags)
		return false;
	picture_free(view->picture);
	view->whole = picture_take(view->picture, diags);
	free(diags);
	return true;
}

enum status picture_live(struct call *call, struct picture *picture)
{
	struct view view = { .picture = picture, .whole = true,
			     .title = picture->map ? picture->map->board :
						     "lines of this machine" };
	bool going = true;

	view.screen.colour = !getenv("NO_COLOR");
	tty_watch_signals();
	if (!tty_open()) {
		tty_close();
		return report_usage(call, "this terminal cannot be used");
	}
	while (going && !tty_stopped())
		going = take(&view) && draw(&view) &&
			take_key(&view, tty_key(FRAME_NS));
	tty_close();
	screen_free(&view.screen);
	sink_memory_free(&view.text);
	return STATUS_GOOD;
}
