/* SPDX-License-Identifier: MIT
 *
 * publish - sets of variables and cells, and their messages.
 */
#include "online/publish.h"

#include "engine/base/name.h"

#include <string.h>

#define FLAG_BYTES 4 /* of a value in a message: index, flags, and one of a STRING's length */

void publish_init(struct publications *all)
{
	memset(all, 0, sizeof(*all));
}

struct publish_set *publish_new(struct publications *all, uint16_t request, uint32_t period_us)
{
	struct publish_set *set = NULL;

	for (int i = 0; i < PUBLISH_SETS; i++) {
		if (!all->set[i].used)
			set = &all->set[i];
		else if (all->set[i].request == request)
			return NULL;
	}
	if (!set)
		return NULL;
	if (period_us < PUBLISH_LEAST_US)
		period_us = PUBLISH_LEAST_US;
	if (period_us > PUBLISH_MOST_US)
		period_us = PUBLISH_MOST_US;
	*set = (struct publish_set){
		.used = true, .request = request, .period_ns = (int64_t)period_us * 1000,
		.first = all->values,
	};
	return set;
}

bool publish_add(struct publications *all, struct publish_set *set, struct location at)
{
	if (all->values == PUBLISH_VALUES)
		return false;
	all->value[all->values++] = (struct published){ .at = at };
	set->count++;
	return true;
}

/* The cells of POU @pou are one after another in the map. */
static void find_cells(const struct program *program, uint32_t pou, struct publish_set *set)
{
	set->count = 0;
	for (uint32_t i = 0; i < program->power_count; i++) {
		if (program->power[i].pou != pou)
			continue;
		if (!set->count++)
			set->cell = i;
	}
}

enum refusal publish_cells(struct publications *all, struct publish_set *set,
			   const struct program *program, const char *name, size_t len)
{
	bool found = false;

	set->what = PUBLISH_CELLS;
	for (uint32_t i = 0; !found && i < program->watched_count; i++) {
		const struct code_watched *watched = &program->watched[i];

		found = name_is(program->string + watched->name, name, len);
		if (!found)
			continue;
		find_cells(program, watched->pou, set);
		set->from = watched->from;
		set->size = watched->size;
		set->to = watched->to;
	}
	for (uint32_t i = 0; !found && i < program->entry_count && program->string_bytes; i++) {
		found = name_is(program->string + program->entry[i].name, name, len);
		if (found)
			find_cells(program, i, set);
	}
	if (!found || !set->count)
		return REFUSAL_NO_NAME;
	if ((set->count + 3) / 4 > PUBLISH_POWER - all->power_bytes) {
		set->count = 0; /* it has no room that could be given back */
		return REFUSAL_TOO_MANY;
	}
	set->first = all->power_bytes;
	all->power_bytes += (set->count + 3) / 4;
	return REFUSAL_NONE;
}

/* Closes the gap that a set leaves, so that the room is always one piece. */
static void close_gap(struct publications *all, const struct publish_set *gone)
{
	const bool cells = gone->what == PUBLISH_CELLS;
	const uint32_t size = cells ? (gone->count + 3) / 4 : gone->count;
	const uint32_t end = gone->first + size;

	if (!size)
		return;
	if (cells)
		memmove(all->power + gone->first, all->power + end, all->power_bytes - end);
	else
		memmove(all->value + gone->first, all->value + end,
			(all->values - end) * sizeof(all->value[0]));
	*(cells ? &all->power_bytes : &all->values) -= size;
	for (int i = 0; i < PUBLISH_SETS; i++)
		if (all->set[i].used && all->set[i].what == gone->what &&
		    all->set[i].first >= end)
			all->set[i].first -= size;
}

bool publish_drop(struct publications *all, uint16_t request)
{
	for (int i = 0; i < PUBLISH_SETS; i++) {
		struct publish_set *set = &all->set[i];

		if (!set->used || set->request != request)
			continue;
		set->used = false;
		close_gap(all, set);
		return true;
	}
	return false;
}

/* Power that is the same for all instances, such as that of the rail, is not copied. */
static uint32_t of_instance(const struct publish_set *set, uint32_t offset)
{
	return offset - set->from < set->size ? set->to + (offset - set->from) : offset;
}

static uint32_t cell_in(const struct program *program, const struct publish_set *set, uint32_t i)
{
	return of_instance(set, program->power[set->cell + i].in);
}

static uint32_t cell_out(const struct program *program, const struct publish_set *set, uint32_t i)
{
	return of_instance(set, program->power[set->cell + i].out);
}

void publish_ranges(const struct publications *all, const struct program *program,
		    void (*take)(void *context, struct range range), void *context)
{
	for (int i = 0; i < PUBLISH_SETS; i++) {
		const struct publish_set *set = &all->set[i];

		for (uint32_t k = 0; set->used && k < set->count; k++) {
			const struct location at = all->value[set->first + k].at;

			if (set->what == PUBLISH_CELLS) {
				take(context, (struct range){ cell_in(program, set, k), 1 });
				take(context, (struct range){ cell_out(program, set, k), 1 });
			} else {
				take(context, (struct range){ place_byte(program, at),
							      place_size(program, at) });
			}
		}
	}
}

bool publish_has_cells(const struct publications *all)
{
	for (int i = 0; i < PUBLISH_SETS; i++)
		if (all->set[i].used && all->set[i].what == PUBLISH_CELLS)
			return true;
	return false;
}

int64_t publish_due(const struct publications *all)
{
	int64_t due_ns = INT64_MAX;

	for (int i = 0; i < PUBLISH_SETS; i++)
		if (all->set[i].used && all->set[i].due_ns < due_ns)
			due_ns = all->set[i].due_ns;
	return due_ns;
}

/* Sets the next time. Periods that are over already are left out, never caught up. */
static void step_due(struct publish_set *set, int64_t now_ns, bool lost)
{
	const int64_t periods = set->due_ns ? (now_ns - set->due_ns) / set->period_ns + 1 : 1;

	if (lost && set->due_ns)
		set->lost += (uint32_t)periods;
	set->due_ns = set->due_ns ? set->due_ns + periods * set->period_ns :
				    now_ns + set->period_ns;
}

void publish_lose(struct publications *all, int64_t now_ns)
{
	for (int i = 0; i < PUBLISH_SETS; i++)
		if (all->set[i].used && all->set[i].due_ns <= now_ns)
			step_due(&all->set[i], now_ns, true);
}

/* FNV-1a: a text is compared by its hash. */
static uint64_t text_hash(const struct iec_string *text)
{
	uint64_t hash = 14695981039346656037u;

	for (uint16_t i = 0; i < text->length; i++)
		hash = (hash ^ (uint8_t)text->text[i]) * 1099511628211u;
	return hash ^ text->length;
}

static uint64_t bits_of(enum iec_type type, union iec_value value)
{
	return type == IEC_STRING ? text_hash(value.s) : (uint64_t)value.i;
}

static void begin(const struct publish_set *set, const struct view *view, struct wire_writer *out)
{
	frame_begin(out, SERVICE_PUBLISH, WIRE_TOLD, set->request);
	wire_put_u8(out, (uint8_t)set->what);
	wire_put_u8(out, (uint8_t)view->state);
	wire_put_u64(out, view->scan);
	wire_put_i64(out, view->now_ns);
	wire_put_u32(out, set->lost);
}

/* Is this variable to be sent, and has the frame room for it? */
static bool put_value(struct published *value, uint16_t index, const struct view *view,
		      const struct image *image, struct wire_writer *out)
{
	const union iec_value now = image_get(image, value->at);
	const uint64_t bits = bits_of(value->at.type, now);
	const uint8_t flags = (image_is_forced(image, value->at) ? VALUE_FORCED : 0) |
			      VIEW_QUALITY(view, image->program, value->at);

	if (value->any && value->sent == bits && value->flags == flags)
		return false;
	if ((size_t)(out->end - out->at) < FLAG_BYTES + IEC_STRING_MOST)
		return false; /* goes with the next message */
	wire_put_u16(out, index);
	wire_put_u8(out, flags);
	wire_put_value(out, value->at.type, now);
	value->sent = bits;
	value->flags = flags;
	value->any = true;
	return true;
}

static size_t write_values(struct publications *all, struct publish_set *set,
			   const struct view *view, const struct image *image,
			   struct wire_writer *out)
{
	uint16_t changed = 0;
	uint8_t *count;

	begin(set, view, out);
	count = out->at;
	wire_put_u16(out, 0);
	for (uint32_t i = 0; i < set->count; i++)
		changed += put_value(&all->value[set->first + i], (uint16_t)i, view, image, out);
	if (!changed && !set->lost)
		return 0;
	count[0] = (uint8_t)changed;
	count[1] = (uint8_t)(changed >> 8);
	return frame_end(out);
}

static size_t write_cells(struct publications *all, struct publish_set *set,
			  const struct view *view, const struct image *image,
			  struct wire_writer *out)
{
	uint8_t *sent = all->power + set->first;
	bool changed = !set->any || set->lost;

	begin(set, view, out);
	for (uint32_t i = 0; i < set->count; i += 4) {
		uint8_t byte = 0;

		for (uint32_t k = 0; k < 4 && i + k < set->count; k++) {
			const uint8_t *m = image->memory;

			byte |= (uint8_t)((m[cell_in(image->program, set, i + k)] & 1) << 2 * k);
			byte |= (uint8_t)((m[cell_out(image->program, set, i + k)] & 1) <<
					  (2 * k + 1));
		}
		changed |= sent[i / 4] != byte;
		sent[i / 4] = byte;
		wire_put_u8(out, byte);
	}
	set->any = true;
	return changed ? frame_end(out) : 0;
}

size_t publish_write(struct publications *all, const struct view *view,
		     const struct image *image, int64_t now_ns, struct wire_writer *out)
{
	for (int i = 0; i < PUBLISH_SETS; i++) {
		struct publish_set *set = &all->set[i];
		struct wire_writer start = *out;
		size_t len;

		if (!set->used || set->due_ns > now_ns || view->serial < set->serial)
			continue;
		len = set->what == PUBLISH_CELLS ?
		      write_cells(all, set, view, image, out) :
		      write_values(all, set, view, image, out);
		step_due(set, now_ns, false);
		if (len) {
			set->lost = 0;
			return len;
		}
		*out = start;
	}
	return 0;
}
