/* SPDX-License-Identifier: MIT
 *
 * sim_history - whole states now and then, and between them the bytes that changed.
 */
#include "editor-gtk/sim/sim_history.h"

#include <string.h>

#define APART 256 /* states from one whole state to the next                   */
#define BLOCK 32u /* bytes that are compared at a time                          */

/* A state. */
struct moment {
	guint64 scan;
	gint64 now_ns;
	enum resource_state state;
	gsize at, len;           /* of its changes in the bytes of the chunk    */
};

/* A whole state, and up to APART - 1 later ones as changes of the one before. */
struct chunk {
	guint64 number;          /* of its first state, counted from 1         */
	GArray *moment;          /* of struct moment                           */
	GByteArray *bytes;       /* the whole state; then, for each other one: of each
				  * changed piece u32 offset, u32 length, bytes */
};

struct sim_history {
	GPtrArray *chunk;        /* of struct chunk, oldest first              */
	GByteArray *last, *now;  /* states, packed                             */
	gsize most, used;
	guint64 count;           /* states that were ever added                */
	guint64 last_scan;
};

static void chunk_free(gpointer pointer)
{
	struct chunk *chunk = pointer;

	g_array_unref(chunk->moment);
	g_byte_array_unref(chunk->bytes);
	g_free(chunk);
}

struct sim_history *sim_history_new(const struct twin *twin, gsize bytes)
{
	struct sim_history *history = g_new0(struct sim_history, 1);

	history->chunk = g_ptr_array_new_with_free_func(chunk_free);
	history->last = g_byte_array_new();
	history->now = g_byte_array_new();
	history->most = MAX(bytes, 4 * twin->memory_size);
	return history;
}

void sim_history_free(struct sim_history *history)
{
	if (!history)
		return;
	g_ptr_array_unref(history->chunk);
	g_byte_array_unref(history->last);
	g_byte_array_unref(history->now);
	g_free(history);
}

/* ---- states as bytes: memory, then forces ---- */

static gsize state_size(const struct twin *twin)
{
	return twin->memory_size + sizeof(twin->resource.image.force) + sizeof(int);
}

static void pack(GByteArray *bytes, const struct twin *twin)
{
	const struct image *image = &twin->resource.image;
	guint8 *at;

	g_byte_array_set_size(bytes, (guint)state_size(twin));
	memcpy(bytes->data, image->memory, twin->memory_size);
	at = bytes->data + twin->memory_size;
	memset(at, 0, sizeof(image->force));
	memcpy(at, image->force, (gsize)image->force_count * sizeof(image->force[0]));
	memcpy(at + sizeof(image->force), &image->force_count, sizeof(int));
}

/* Writes bytes of a state from @offset on. */
static void put(struct twin *twin, gsize offset, const guint8 *from, gsize len)
{
	struct image *image = &twin->resource.image;
	const gsize memory = twin->memory_size, forces = sizeof(image->force);

	for (gsize i = 0; i < len;) {
		const gsize at = offset + i;
		const gsize end = at < memory ? memory : at < memory + forces ?
				  memory + forces : memory + forces + sizeof(int);
		const gsize piece = MIN(len - i, end - at);

		memcpy(at < memory ? image->memory + at : at < memory + forces ?
		       (guint8 *)image->force + (at - memory) :
		       (guint8 *)&image->force_count + (at - memory - forces), from + i, piece);
		i += piece;
	}
}

/* ---- adding ---- */

static struct chunk *newest(const struct sim_history *history)
{
	return history->chunk->len ? history->chunk->pdata[history->chunk->len - 1] : NULL;
}

static void put_piece(GByteArray *bytes, const GByteArray *state, gsize from, gsize end)
{
	const guint32 head[2] = { (guint32)from, (guint32)(end - from) };

	g_byte_array_append(bytes, (const guint8 *)head, sizeof(head));
	g_byte_array_append(bytes, state->data + from, (guint)(end - from));
}

static void put_changes(GByteArray *bytes, const GByteArray *last, const GByteArray *now)
{
	gsize from = 0, end = 0;

	for (gsize at = 0; at < now->len; at += BLOCK) {
		const gsize size = MIN(BLOCK, now->len - at);

		if (memcmp(last->data + at, now->data + at, size) == 0)
			continue;
		if (end != at && end)
			put_piece(bytes, now, from, end);
		if (end != at || !end)
			from = at;
		end = at + size;
	}
	if (end)
		put_piece(bytes, now, from, end);
}

static gsize chunk_bytes(const struct chunk *chunk)
{
	return sizeof(*chunk) + chunk->bytes->len + chunk->moment->len * sizeof(struct moment);
}

static struct chunk *begin_chunk(struct sim_history *history)
{
	struct chunk *chunk = g_new0(struct chunk, 1);

	chunk->number = history->count + 1;
	chunk->moment = g_array_new(FALSE, FALSE, sizeof(struct moment));
	chunk->bytes = g_byte_array_new();
	g_ptr_array_add(history->chunk, chunk);
	history->used += sizeof(*chunk);
	return chunk;
}

static void keep_bound(struct sim_history *history)
{
	while (history->chunk->len > 1 && history->used > history->most) {
		history->used -= chunk_bytes(history->chunk->pdata[0]);
		g_ptr_array_remove_index(history->chunk, 0);
	}
}

void sim_history_add(struct sim_history *history, const struct twin *twin)
{
	struct chunk *chunk = newest(history);
	const bool whole = !chunk || chunk->moment->len == APART;
	struct moment moment = { .scan = twin->scan, .now_ns = twin->now_ns,
				 .state = twin->resource.state };
	GByteArray *swap = history->last;

	if (whole)
		chunk = begin_chunk(history);
	pack(history->now, twin);
	moment.at = chunk->bytes->len;
	if (whole)
		g_byte_array_append(chunk->bytes, history->now->data, history->now->len);
	else
		put_changes(chunk->bytes, history->last, history->now);
	moment.len = chunk->bytes->len - moment.at;
	g_array_append_val(chunk->moment, moment);
	history->used += moment.len + sizeof(moment);
	history->last = history->now;
	history->now = swap;
	history->count++;
	history->last_scan = twin->scan;
	keep_bound(history);
}

/* ---- showing again ---- */

static const struct moment *moment_at(const struct chunk *chunk, guint index)
{
	return &g_array_index(chunk->moment, struct moment, index);
}

guint64 sim_history_first(const struct sim_history *history)
{
	return history->chunk->len ? moment_at(history->chunk->pdata[0], 0)->scan : 0;
}

guint64 sim_history_last(const struct sim_history *history)
{
	return history->last_scan;
}

/* The last chunk that begins at @scan or before. */
static const struct chunk *find_chunk(const struct sim_history *history, guint64 scan)
{
	guint low = 0, high = history->chunk->len;

	while (high - low > 1) {
		const guint middle = low + (high - low) / 2;

		if (moment_at(history->chunk->pdata[middle], 0)->scan <= scan)
			low = middle;
		else
			high = middle;
	}
	return history->chunk->pdata[low];
}

static guint find_moment(const struct chunk *chunk, guint64 scan)
{
	guint low = 0, high = chunk->moment->len;

	while (high - low > 1) {
		const guint middle = low + (high - low) / 2;

		if (moment_at(chunk, middle)->scan <= scan)
			low = middle;
		else
			high = middle;
	}
	return low;
}

static void apply(const struct chunk *chunk, guint index, struct twin *twin)
{
	const struct moment *moment = moment_at(chunk, index);
	const guint8 *at = chunk->bytes->data + moment->at, *end = at + moment->len;

	if (index == 0) {
		put(twin, 0, at, moment->len);
		return;
	}
	while (at < end) {
		guint32 head[2];

		memcpy(head, at, sizeof(head));
		put(twin, head[0], at + sizeof(head), head[1]);
		at += sizeof(head) + head[1];
	}
}

bool sim_history_seek(const struct sim_history *history, guint64 *at, struct twin *twin,
		      guint64 scan)
{
	const struct chunk *chunk;
	const struct moment *moment;
	guint index, from = 0;

	if (!history->count || scan < sim_history_first(history) || scan > history->last_scan)
		return false;
	chunk = find_chunk(history, scan);
	index = find_moment(chunk, scan);
	if (*at >= chunk->number && *at <= chunk->number + index)
		from = (guint)(*at - chunk->number) + 1;
	for (guint i = from; i <= index; i++)
		apply(chunk, i, twin);
	*at = chunk->number + index;
	moment = moment_at(chunk, index);
	twin->scan = scan;
	twin->now_ns = moment->now_ns + (gint64)(scan - moment->scan) * twin->period_ns;
	twin->resource.state = moment->state;
	twin->resource.scans = scan;
	return true;
}
