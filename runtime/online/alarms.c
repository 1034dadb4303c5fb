/* SPDX-License-Identifier: MIT
 *
 * alarms - watches blocks after a scan; keeps the list.
 */
#include "online/alarms.h"

#include "engine/base/digest.h"

#include <stdlib.h>
#include <string.h>

#define AGAIN_NS INT64_C(60000000000) /* an alarm that comes again within it keeps its row */

/* Where the blocks that are watched have their pins. */
struct pins {
	const char *word;
	uint32_t count, text, class, state, ack; /* 0: it has no such pin      */
};
#define PINS(id) #id, offsetof(struct fb_##id, COUNT), offsetof(struct fb_##id, MSG), \
	offsetof(struct fb_##id, CLASS)
static const struct pins pins[] = {
	[ALARM_OF_CONDITION] = { PINS(ALARM), offsetof(struct fb_ALARM, STATE),
				 offsetof(struct fb_ALARM, OP_ACK) },
	[ALARM_OF_LIMIT] = { PINS(ALARM_LIMIT), offsetof(struct fb_ALARM_LIMIT, STATE),
			     offsetof(struct fb_ALARM_LIMIT, OP_ACK) },
	[ALARM_OF_EVENT] = { PINS(EVENT), 0, 0 },
};
#define KINDS (sizeof(pins) / sizeof(pins[0]))

static const struct {
	const char *name, *text;
	bool quiet;            /* needs no acknowledgement                     */
} systems[ALARM_SYSTEMS] = {
#define ALARM(id, name, quiet, text) { name, text, quiet },
#include "online/alarms.def"
};

/* ---- watched blocks ---- */

/* The kind of the block whose COUNT this is; KINDS: of none. */
static size_t kind_of(const struct symbol *symbol, size_t *len)
{
	static const char pin[] = ".COUNT";
	const size_t all = strlen(symbol->name);
	size_t kind = 0;

	if (!symbol->block || all < sizeof(pin) || symbol->at.area != AREA_NONE)
		return KINDS;
	*len = all - (sizeof(pin) - 1);
	if (strcmp(symbol->name + *len, pin) != 0)
		return KINDS;
	while (kind < KINDS && strcmp(symbol->block, pins[kind].word) != 0)
		kind++;
	return kind;
}

static uint32_t walk(const struct image *image, struct alarm_watch *out)
{
	struct symbol_cursor cursor = { .whole = false };
	struct symbol symbol;
	uint32_t count = 0;
	size_t len;

	while (image->program->string_bytes && image_next_symbol(image, &cursor, &symbol)) {
		const size_t kind = kind_of(&symbol, &len);

		if (kind == KINDS || symbol.flags & SYMBOL_HIDDEN)
			continue;
		if (out && count < out->count) {
			out->block[count] = (struct alarm_block){
				.at = symbol.at.where - pins[kind].count, .kind = (uint32_t)kind,
			};
			wire_cut(out->block[count].name, sizeof(out->block[count].name), symbol.name,
			     len);
		}
		count++;
	}
	return count;
}

struct alarm_watch *alarm_watch_new(const struct image *image)
{
	const uint32_t all = walk(image, NULL);
	const uint32_t count = all < ALARM_MOST ? all : ALARM_MOST;
	struct alarm_watch *watch = calloc(1, sizeof(*watch) + count * sizeof(watch->block[0]));

	if (!watch)
		return NULL;
	watch->program = image->program;
	watch->count = count;
	watch->left_out = all - count;
	walk(image, watch);
	return watch;
}

const struct alarm_block *alarm_block_find(const struct alarm_watch *watch, const char *name)
{
	for (uint32_t i = 0; i < watch->count; i++)
		if (strcmp(watch->block[i].name, name) == 0)
			return &watch->block[i];
	return NULL;
}

void alarm_watch_carry(struct alarm_watch *to, const struct alarm_watch *from)
{
	uint32_t next = 0; /* both have much the same order */

	for (uint32_t i = 0; i < to->count; i++)
		for (uint32_t k = 0; k < from->count; k++) {
			const uint32_t at = (next + k) % from->count;

			if (to->block[i].kind != from->block[at].kind ||
			    strcmp(to->block[i].name, from->block[at].name) != 0)
				continue;
			to->block[i].count = from->block[at].count;
			next = at + 1;
			break;
		}
}

struct location alarm_block_ack(const struct alarm_block *block)
{
	const uint32_t ack = pins[block->kind].ack;

	return (struct location){ .type = ack ? IEC_BOOL : IEC_NONE, .where = block->at + ack };
}

/* ---- the scan thread ---- */

static struct alarm_note *room(struct alarm_ring *ring)
{
	const uint32_t put = atomic_load_explicit(&ring->put, memory_order_relaxed);

	if (put - atomic_load_explicit(&ring->taken, memory_order_acquire) >= ALARM_RING)
		return NULL;
	return &ring->note[put % ALARM_RING];
}

static void tell(struct alarm_ring *ring)
{
	atomic_fetch_add_explicit(&ring->put, 1, memory_order_release);
}

static int64_t time_of(const struct resource *resource)
{
	return resource->vm.now_ns - resource->timers_ns;
}

/* Whether there was room. */
static bool look_at(struct alarm_ring *ring, const struct resource *resource,
		    struct alarm_block *block)
{
	const struct pins *of = &pins[block->kind];
	const uint8_t *at = resource->image.memory + block->at;
	const struct iec_string *text = (const void *)(at + of->text);
	const uint8_t state = of->state ? at[of->state] : (uint8_t)ALARM_EVENT;
	struct alarm_note *note;
	uint32_t count;

	memcpy(&count, at + of->count, sizeof(count));
	if (count == block->count && (state == block->state || !of->state))
		return true;
	note = room(ring);
	if (!note)
		return false;
	*note = (struct alarm_note){ .state = state, .class = at[of->class],
				     .times = count < block->count ? count : count - block->count,
				     .time_ns = time_of(resource) };
	memcpy(note->name, block->name, sizeof(note->name));
	wire_cut(note->text, sizeof(note->text), text->text,
	     text->length < WORD_TEXT ? text->length : WORD_TEXT);
	block->count = count;
	block->state = state;
	tell(ring);
	return true;
}

void alarm_begin(struct alarm_ring *ring, const struct resource *resource)
{
	struct alarm_watch *watch = atomic_load_explicit(&ring->watch, memory_order_acquire);

	if (!watch || watch->program != resource->image.program)
		return;
	for (uint32_t i = 0; i < watch->count; i++) {
		struct alarm_block *block = &watch->block[i];

		memcpy(&block->count, resource->image.memory + block->at + pins[block->kind].count,
		       sizeof(block->count));
	}
}

static void look_at_system(struct alarm_ring *ring, const struct resource *resource)
{
	const uint8_t now = (uint8_t)((resource->image.force_count > 0) << ALARM_FORCED |
				      resource->retain_lost << ALARM_RETAIN_LOST |
				      resource->late << ALARM_LATE |
				      resource->io_fault << ALARM_IO |
				      (resource->state == STATE_FAULT) << ALARM_FAULT);

	for (uint8_t i = 0; i < ALARM_SYSTEMS; i++) {
		struct alarm_note *note = (now ^ ring->systems) >> i & 1 ? room(ring) : NULL;

		if (!note)
			continue;
		*note = (struct alarm_note){ .state = now >> i & 1, .system = (uint8_t)(i + 1),
					     .time_ns = time_of(resource) };
		ring->systems ^= (uint8_t)(1u << i);
		tell(ring);
	}
}

void alarm_look(struct alarm_ring *ring, const struct resource *resource)
{
	struct alarm_watch *watch = atomic_load_explicit(&ring->watch, memory_order_acquire);
	struct alarm_note *note;
	bool all = true;

	look_at_system(ring, resource);
	if (!watch || watch->program != resource->image.program || !resource->scans)
		return;
	if (watch != ring->seen)
		ring->synced = false;
	ring->seen = watch;
	for (uint32_t i = 0; i < watch->count && all; i++)
		all = look_at(ring, resource, &watch->block[i]);
	note = all && !ring->synced ? room(ring) : NULL;
	if (!note)
		return;
	*note = (struct alarm_note){ .sync = 1, .time_ns = time_of(resource) };
	ring->synced = true;
	tell(ring);
}

bool alarm_take(struct alarm_ring *ring, struct alarm_note *out)
{
	const uint32_t taken = atomic_load_explicit(&ring->taken, memory_order_relaxed);

	if (taken == atomic_load_explicit(&ring->put, memory_order_acquire))
		return false;
	*out = ring->note[taken % ALARM_RING];
	atomic_store_explicit(&ring->taken, taken + 1, memory_order_release);
	return true;
}

/* ---- the list ---- */

static bool is_active(const struct alarm_row *row)
{
	return row->number && (row->state == ALARM_UNACK || row->state == ALARM_ACKED);
}

bool alarm_waits(const struct alarm_row *row)
{
	return row->number && (row->state == ALARM_UNACK || row->state == ALARM_GONE_UNACK);
}

static void touch(struct alarm_list *list, const struct alarm_row *row)
{
	list->dirty[row - list->row] = list->changed = true;
}

/* The newest row of this name. */
static struct alarm_row *find_name(struct alarm_list *list, const char *name)
{
	struct alarm_row *found = NULL;

	for (uint32_t i = 0; i < ALARM_ROWS; i++)
		if (list->row[i].number && strcmp(list->row[i].name, name) == 0 &&
		    (!found || list->row[i].number > found->number))
			found = &list->row[i];
	return found;
}

/* A free row, else the oldest that has finished; NULL: all are needed. */
static struct alarm_row *find_room(struct alarm_list *list)
{
	struct alarm_row *found = NULL;

	for (uint32_t i = 0; i < ALARM_ROWS; i++) {
		struct alarm_row *row = &list->row[i];

		if (!row->number)
			return row;
		if (!is_active(row) && !alarm_waits(row) && (!found || row->number < found->number))
			found = row;
	}
	return found;
}

/* The row that goes on, or a new one; NULL: no room, or nothing came. */
static struct alarm_row *row_of(struct alarm_list *list, const struct alarm_note *note)
{
	struct alarm_row *row = find_name(list, note->name);
	const bool comes = note->times || note->state == ALARM_UNACK || note->state == ALARM_ACKED;
	const int64_t last_ns = row ? (row->went_ns ? row->went_ns : row->came_ns) : 0;

	if (row && (is_active(row) || alarm_waits(row) ||
		    (note->time_ns >= last_ns && note->time_ns - last_ns < AGAIN_NS)))
		return row;
	if (!comes)
		return NULL;
	row = find_room(list);
	if (!row) {
		list->lost += note->times;
		return NULL;
	}
	*row = (struct alarm_row){ .number = ++list->last, .came_ns = note->time_ns,
				   .times = !note->times };
	memcpy(row->name, note->name, sizeof(row->name));
	return row;
}

static void update(struct alarm_list *list, const struct alarm_note *note)
{
	struct alarm_row *row = row_of(list, note);

	if (!row)
		return;
	list->unsure[row - list->row] = false;
	row->class = note->class;
	memcpy(row->text, note->text, sizeof(row->text));
	row->times += note->times;
	if (note->state == ALARM_EVENT) {
		row->state = ALARM_EVENT;
		row->went_ns = note->time_ns;
		touch(list, row);
		return;
	}
	if ((note->state == ALARM_ACKED || note->state == ALARM_NORMAL) && alarm_waits(row))
		row->acked_ns = note->time_ns, row->who[0] = '\0';
	if (note->state == ALARM_UNACK || note->state == ALARM_ACKED)
		row->went_ns = 0;
	else if (is_active(row) || note->times)
		row->went_ns = note->time_ns;
	if (note->times && note->state != ALARM_ACKED && note->state != ALARM_NORMAL)
		row->acked_ns = 0, row->who[0] = '\0';
	row->state = note->state;
	touch(list, row);
}

static void update_system(struct alarm_list *list, uint8_t system, bool active, int64_t time_ns)
{
	struct alarm_note note = { .time_ns = time_ns, .times = active };
	const struct alarm_row *row = find_name(list, systems[system].name);
	bool waits = row && alarm_waits(row);

	if (row)
		list->unsure[row - list->row] = false;
	if (row ? is_active(row) == active : !active)
		return;
	wire_cut(note.name, sizeof(note.name), systems[system].name, strlen(systems[system].name));
	wire_cut(note.text, sizeof(note.text), systems[system].text, strlen(systems[system].text));
	waits |= active && !systems[system].quiet;
	note.state = (uint8_t)(active ? 2 - waits : 3 * waits);
	update(list, &note);
}

void alarm_list_raise(struct alarm_list *list, enum alarm_system system, bool active, int64_t time_ns)
{
	update_system(list, (uint8_t)system, active, time_ns);
}

void alarm_list_doubt(struct alarm_list *list, bool begins)
{
	for (uint32_t i = 0; i < ALARM_ROWS; i++)
		list->unsure[i] = is_active(&list->row[i]) && (begins || list->row[i].class);
}

static void settle(struct alarm_list *list, int64_t time_ns)
{
	for (uint32_t i = 0; i < ALARM_ROWS; i++) {
		struct alarm_row *row = &list->row[i];

		if (!list->unsure[i] || !is_active(row))
			continue;
		row->state = row->state == ALARM_UNACK ? ALARM_GONE_UNACK : ALARM_NORMAL;
		row->went_ns = time_ns;
		touch(list, row);
	}
	memset(list->unsure, 0, sizeof(list->unsure));
}

void alarm_list_note(struct alarm_list *list, const struct alarm_note *note)
{
	struct alarm_note sound = *note;

	if (note->sync)
		settle(list, note->time_ns);
	else if (note->system)
		update_system(list, (uint8_t)(note->system - 1), note->state != 0, note->time_ns);
	else {
		sound.class = note->class == 1 || note->class == 3 ? note->class : 2;
		update(list, &sound);
	}
}

struct alarm_row *alarm_list_find(struct alarm_list *list, uint32_t number)
{
	for (uint32_t i = 0; number && i < ALARM_ROWS; i++)
		if (list->row[i].number == number)
			return &list->row[i];
	return NULL;
}

const struct alarm_row *alarm_list_next(const struct alarm_list *list, uint32_t number)
{
	const struct alarm_row *found = NULL;

	for (uint32_t i = 0; i < ALARM_ROWS; i++) {
		const struct alarm_row *row = &list->row[i];

		if (row->number && row->number >= number &&
		    (!found || row->number < found->number))
			found = row;
	}
	return found;
}

void alarm_list_ack(struct alarm_list *list, uint32_t number, const char *who, int64_t time_ns)
{
	struct alarm_row *row = alarm_list_find(list, number);

	if (!row || !alarm_waits(row))
		return;
	row->state = row->state == ALARM_UNACK ? ALARM_ACKED : ALARM_NORMAL;
	row->acked_ns = time_ns;
	wire_cut(row->who, sizeof(row->who), who, strlen(who));
	touch(list, row);
}

void alarm_list_count(const struct alarm_list *list, uint32_t *active, uint32_t *waiting)
{
	*active = *waiting = 0;
	for (uint32_t i = 0; i < ALARM_ROWS; i++) {
		*active += is_active(&list->row[i]);
		*waiting += alarm_waits(&list->row[i]);
	}
}

/* ---- bytes ---- */

void alarm_put(struct wire_writer *out, const struct alarm_row *row)
{
	wire_put_u32(out, row->number);
	wire_put_u32(out, row->times);
	wire_put_u8(out, row->state);
	wire_put_u8(out, row->class);
	wire_put_i64(out, row->came_ns);
	wire_put_i64(out, row->went_ns);
	wire_put_i64(out, row->acked_ns);
	wire_put_string(out, row->name);
	wire_put_string(out, row->text);
	wire_put_string(out, row->who);
}

void alarm_read(struct wire_reader *in, struct alarm_row *row)
{
	memset(row, 0, sizeof(*row));
	row->number = wire_u32(in);
	row->times = wire_u32(in);
	row->state = wire_u8(in);
	row->class = wire_u8(in);
	row->came_ns = wire_i64(in);
	row->went_ns = wire_i64(in);
	row->acked_ns = wire_i64(in);
	wire_copy_text(in, row->name, sizeof(row->name));
	wire_copy_text(in, row->text, sizeof(row->text));
	wire_copy_text(in, row->who, sizeof(row->who));
}

void alarm_seal(const struct alarm_row *row, uint32_t version, uint8_t *out)
{
	struct wire_writer body = wire_write(out, ALARM_BYTES - 4);
	struct wire_writer tail = wire_write(out + ALARM_BYTES - 4, 4);

	memset(out, 0, ALARM_BYTES);
	wire_put_u32(&body, version);
	alarm_put(&body, row);
	wire_put_u32(&tail, digest_crc32c(0, out, ALARM_BYTES - 4));
}

bool alarm_open(const uint8_t *bytes, struct alarm_row *row, uint32_t *version, bool *empty)
{
	struct wire_reader body = wire_read(bytes, ALARM_BYTES - 4);
	struct wire_reader tail = wire_read(bytes + ALARM_BYTES - 4, 4);

	*empty = true;
	for (uint32_t i = 0; i < ALARM_BYTES; i++)
		*empty &= bytes[i] == 0;
	*version = wire_u32(&body);
	alarm_read(&body, row);
	return !body.failed && row->number && row->state <= ALARM_EVENT && row->class <= 3 &&
	       wire_u32(&tail) == digest_crc32c(0, bytes, ALARM_BYTES - 4);
}

const char *alarm_state_word(uint8_t state)
{
	static const char *const word[] = { "gone", "active", "acknowledged",
					    "gone, not acknowledged", "event" };

	return state < sizeof(word) / sizeof(word[0]) ? word[state] : "?";
}

const char *alarm_class_word(uint8_t class)
{
	static const char *const word[] = { "system", "error", "warning", "notice" };

	return class < sizeof(word) / sizeof(word[0]) ? word[class] : "?";
}
