/* SPDX-License-Identifier: MIT
 *
 * board - lamps, switches and the simulated lines behind them.
 */
#include "ladder/board.h"

#include "engine/scan/value.h"
#include "hal/sim.h"

#include <stdlib.h>
#include <string.h>

#define RUN_MAX 64 /* longer ranges of undeclared bits get no lamps         */

static bool same_bit(struct location a, struct location b)
{
	return a.area == b.area && a.where == b.where;
}

static struct lamps *lamps_of(struct board *board, struct location at)
{
	if (at.type != IEC_BOOL)
		return NULL;
	if (at.area == AREA_I)
		return &board->input;
	return at.area == AREA_Q ? &board->output : NULL;
}

static struct iec_addr address_of(struct location at)
{
	return (struct iec_addr){ .area = at.area, .bits = 1,
				  .bit = at.where % 8, .byte = at.where / 8 };
}

/* The point of the I/O map at an address; NULL: none, or no map. */
static const struct io_point *point_at(const struct board *board, struct location at)
{
	for (int i = 0; board->mapped && i < board->map.count; i++) {
		const struct io_point *point = &board->map.point[i];

		if (point->addr.area == at.area &&
		    point->addr.byte * 8 + point->addr.bit == at.where)
			return point;
	}
	return NULL;
}

/* A second name of the same bit adds no lamp. */
static bool add_lamp(struct board *board, struct location at, const char *name)
{
	const struct io_point *point = point_at(board, at);
	struct lamps *lamps = lamps_of(board, at);
	struct lamp *lamp;

	if (!lamps)
		return true;
	for (int i = 0; i < lamps->count; i++)
		if (same_bit(lamps->lamp[i].at, at))
			return true;
	lamp = arena_push(&board->arena, &lamps->lamp, &lamps->count,
			  sizeof(*lamp));
	if (!lamp)
		return false;
	lamp->at = at;
	iec_addr_print(address_of(at), lamp->address, sizeof(lamp->address));
	lamp->line = point && point->line ? point->line : "";
	lamp->name = arena_copy(&board->arena, name, strlen(name));
	return lamp->name != NULL;
}

bool moving_update(struct moving *moving, union iec_value value)
{
	bool same = value.i == moving->last.i;

	if (moving->at.type == IEC_STRING) {
		struct iec_string *last = (struct iec_string *)moving->last.s;

		same = value_order(value.s, last) == 0;
		iec_store(last, IEC_STRING, value);
	} else {
		moving->last = value;
	}
	return !same;
}

static bool own_text(struct board *board, struct moving *moving)
{
	uint16_t capacity =
		image_get(&board->resource->image, moving->at).s->capacity;
	struct iec_string *text = arena_alloc(&board->arena,
					      iec_type_size(IEC_STRING, capacity));

	if (!text)
		return false;
	text->capacity = capacity;
	moving->last.s = text;
	return true;
}

static bool add_moving(struct board *board, const struct symbol *symbol)
{
	struct moving *moving = arena_push(&board->arena, &board->moving,
					   &board->moving_count,
					   sizeof(*moving));

	if (!moving)
		return false;
	moving->at = symbol->at;
	if (moving->at.type == IEC_STRING && !own_text(board, moving))
		return false;
	moving->name = arena_copy(&board->arena, symbol->name,
				  strlen(symbol->name));
	return moving->name != NULL;
}

static bool add_declared(struct board *board)
{
	const struct image *image = &board->resource->image;
	struct symbol_cursor cursor = { 0 };
	struct symbol symbol;
	bool good = true;

	while (good && image_next_symbol(image, &cursor, &symbol)) {
		if (symbol.flags & (SYMBOL_HIDDEN | SYMBOL_CONSTANT))
			continue;
		if (lamps_of(board, symbol.at))
			good = add_lamp(board, symbol.at, symbol.name);
		else if (!symbol.is_input)
			good = add_moving(board, &symbol);
	}
	return good;
}

/* Lamps for bits that the program uses by address. */
static bool add_used(struct board *board)
{
	const struct program *program = board->resource->image.program;
	bool good = true;

	for (uint32_t i = 0; i < program->bits_count; i++) {
		const struct code_bits *bits = &program->bits[i];

		for (uint32_t k = 0; good && k < bits->count &&
		     bits->count <= RUN_MAX; k++)
			good = add_lamp(board, (struct location){
				.type = IEC_BOOL,
				.area = (enum iec_area)bits->area,
				.where = bits->first + k }, "");
	}
	return good;
}

static bool add_mapped(struct board *board)
{
	bool good = true;

	for (int i = 0; good && board->mapped && i < board->map.count; i++) {
		struct iec_addr addr = board->map.point[i].addr;

		good = add_lamp(board, (struct location){
			.type = IEC_BOOL, .area = addr.area,
			.where = addr.byte * 8 + addr.bit }, "");
	}
	return good;
}

static enum status read_map(struct board *board, const char *path)
{
	size_t len;
	char *text = report_read(path, &len);
	struct diag_list *diags = text ? report_list(path) : NULL;

	if (!diags) {
		free(text);
		return STATUS_WRONG;
	}
	board->mapped = iomap_read(&board->map, &board->arena, path, text, len, diags) &&
			iomap_check_program(&board->map, board->resource->image.program,
					    &board->arena, diags);
	for (int i = 0; board->mapped && i < board->map.count; i++)
		board->map.point[i].driver = DRIVER_sim;
	board->mapped = board->mapped && hal_open(&board->hal, &board->map,
						  &board->arena, diags);
	report_end(diags);
	free(text);
	return board->mapped ? STATUS_GOOD : STATUS_NO;
}

/* Sets the input of a switch, or the level of its line: of an inverted line TRUE is low. */
static void move_wire(struct board *board, const struct lamp *lamp)
{
	struct iec_addr addr = address_of(lamp->at);
	struct request *request = NULL;
	uint32_t line;

	if (board->mapped)
		request = hal_find(&board->hal, addr, &line);
	if (!request) {
		image_set_bit(&board->resource->image, lamp->at.area,
			      lamp->at.where, lamp->wanted);
		return;
	}
	sim_set(request, line,
		lamp->wanted != request->line[line].point->active_low);
}

static void move_all(struct board *board)
{
	for (int i = 0; i < board->input.count; i++)
		move_wire(board, &board->input.lamp[i]);
}

enum status board_open(struct board *board, struct machine *machine,
		       const char *map)
{
	enum status status = STATUS_GOOD;

	memset(board, 0, sizeof(*board));
	arena_init(&board->arena);
	board->resource = &machine->resource;
	board->plant = machine_plant(machine);
	if (map)
		status = read_map(board, map);
	if (status != STATUS_GOOD)
		return status;
	if (!add_declared(board) || !add_used(board) || !add_mapped(board))
		return report_no_memory("ladder run");
	board_start(board);
	return STATUS_GOOD;
}

void board_close(struct board *board)
{
	if (board->mapped)
		hal_close(&board->hal);
	arena_free(&board->arena);
}

void board_start(struct board *board)
{
	resource_start(board->resource);
	if (board->plant)
		resource_start(&board->plant->resource);
	if (board->mapped)
		hal_release(&board->hal);
	move_all(board);
	for (int i = 0; i < board->moving_count; i++) {
		struct moving *moving = &board->moving[i];

		moving_update(moving, image_get(&board->resource->image,
						moving->at));
		moving->moved = false;
	}
}

void board_set(struct board *board, struct location at, union iec_value value)
{
	for (int i = 0; i < board->input.count; i++) {
		struct lamp *lamp = &board->input.lamp[i];

		if (at.type != IEC_BOOL || !same_bit(lamp->at, at))
			continue;
		lamp->wanted = value.i != 0;
		move_wire(board, lamp);
		return;
	}
	image_set(&board->resource->image, at, value);
}

bool board_is_on(const struct board *board, const struct lamp *lamp)
{
	const struct io_point *point = point_at(board, lamp->at);

	if (board->resource->state == STATE_RUN || lamp->at.area != AREA_Q ||
	    (point && point->hold))
		return image_get_bit(&board->resource->image, lamp->at.area,
				     lamp->at.where);
	return point && point->safe;
}

void board_toggle(struct board *board, int index)
{
	if (index < 0 || index >= board->input.count)
		return;
	board->input.lamp[index].wanted = !board->input.lamp[index].wanted;
	move_wire(board, &board->input.lamp[index]);
}

bool board_scan(struct board *board, int64_t now_ns)
{
	struct image *image = &board->resource->image;
	bool good;

	if (board->mapped)
		ReadPhysicalInputs(&board->hal, image, now_ns);
	if (board->plant && board->resource->state == STATE_RUN)
		plant_scan(board->plant, image, now_ns);
	good = resource_scan(board->resource, now_ns);
	if (board->mapped && good)
		WritePhysicalOutputs(&board->hal, image, now_ns);
	else if (board->mapped)
		hal_write_safe(&board->hal);
	return good;
}
