/* SPDX-License-Identifier: MIT
 *
 * names - every string of a project, stored once and known by a number.
 *
 * An open hash of ids, at most half full. It never forgets a string and knows
 * nothing of what one means.
 */
#include "engine/base/names.h"

#include <string.h>

struct names_entry {
	const char *text;
	uint32_t len;
	uint32_t hash;
	uint32_t fold; /* id + 1 of the folded spelling; 0: not asked yet     */
};

#define FIRST_SLOTS 256u

static char fold_byte(char c)
{
	return c >= 'a' && c <= 'z' ? (char)(c - 'a' + 'A') : c;
}

/* FNV-1a. The last step spreads the high bits to those that pick the slot. */
static uint32_t hash_bytes(const char *text, size_t len)
{
	uint32_t hash = 2166136261u;

	for (size_t i = 0; i < len; i++)
		hash = (hash ^ (uint8_t)text[i]) * 16777619u;
	return hash ^ hash >> 15;
}

static uint32_t hash_folded(const char *text, size_t len)
{
	uint32_t hash = 2166136261u;

	for (size_t i = 0; i < len; i++)
		hash = (hash ^ (uint8_t)fold_byte(text[i])) * 16777619u;
	return hash ^ hash >> 15;
}

void names_init(struct names *names, struct arena *arena)
{
	struct names_entry *empty;

	*names = (struct names){ .arena = arena };
	names->slot = arena_alloc(arena, FIRST_SLOTS * sizeof(uint32_t));
	empty = arena_push(arena, &names->entry, &names->count, sizeof(*empty));
	if (!names->slot || !empty) {
		names->count = 0;
		return;
	}
	names->mask = FIRST_SLOTS - 1;
	*empty = (struct names_entry){ .text = "", .fold = 1 };
}

static bool same_folded(const char *folded, const char *text, size_t len)
{
	for (size_t i = 0; i < len; i++)
		if (folded[i] != fold_byte(text[i]))
			return false;
	return true;
}

/* The slot of a string, or the free one where it belongs. @fold: of the string
 * that @text is when folded. */
static uint32_t find_slot(const struct names *names, const char *text,
			  size_t len, uint32_t hash, bool fold)
{
	uint32_t at = hash & names->mask;

	for (; names->slot[at]; at = (at + 1) & names->mask) {
		const struct names_entry *entry =
			&names->entry[names->slot[at]];

		if (entry->hash != hash || entry->len != len)
			continue;
		if (fold ? same_folded(entry->text, text, len) :
			   memcmp(entry->text, text, len) == 0)
			break;
	}
	return at;
}

static bool double_slots(struct names *names)
{
	uint32_t size = (names->mask + 1) * 2;
	uint32_t *slot = arena_alloc(names->arena, size * sizeof(*slot));

	if (!slot)
		return false;
	names->slot = slot;
	names->mask = size - 1;
	for (int id = 1; id < names->count; id++) {
		uint32_t at = names->entry[id].hash & names->mask;

		while (slot[at])
			at = (at + 1) & names->mask;
		slot[at] = (uint32_t)id;
	}
	return true;
}

/* Makes the entry of @slot; @text already lives in the arena. */
static uint32_t add_entry(struct names *names, uint32_t slot, const char *text,
			  size_t len, uint32_t hash)
{
	uint32_t id = (uint32_t)names->count;
	struct names_entry *entry;

	if (!text)
		return 0;
	entry = arena_push(names->arena, &names->entry, &names->count,
			   sizeof(*entry));
	if (!entry)
		return 0;
	*entry = (struct names_entry){ .text = text, .len = (uint32_t)len,
				       .hash = hash };
	names->slot[slot] = id;
	return id;
}

static bool has_room(struct names *names)
{
	return (uint32_t)names->count * 2 <= names->mask || double_slots(names);
}

uint32_t names_intern(struct names *names, const char *text, size_t len)
{
	uint32_t hash, slot;

	if (len == 0 || len >= UINT32_MAX || !names->count || !has_room(names))
		return 0;
	hash = hash_bytes(text, len);
	slot = find_slot(names, text, len, hash, false);
	if (names->slot[slot])
		return names->slot[slot];
	return add_entry(names, slot, arena_copy(names->arena, text, len), len,
			 hash);
}

uint32_t names_find(const struct names *names, const char *text, size_t len)
{
	if (len == 0 || len >= UINT32_MAX || !names->count)
		return 0;
	return names->slot[find_slot(names, text, len, hash_bytes(text, len),
				     false)];
}

const char *names_text(const struct names *names, uint32_t id)
{
	return id < (uint32_t)names->count ? names->entry[id].text : "";
}

size_t names_len(const struct names *names, uint32_t id)
{
	return id < (uint32_t)names->count ? names->entry[id].len : 0;
}

static uint32_t intern_folded(struct names *names, uint32_t id)
{
	const char *text = names->entry[id].text;
	size_t len = names->entry[id].len;
	uint32_t hash = hash_folded(text, len), slot, made;
	char *folded;

	if (!has_room(names))
		return 0;
	slot = find_slot(names, text, len, hash, true);
	if (names->slot[slot])
		return names->slot[slot];
	folded = arena_copy(names->arena, text, len);
	if (!folded)
		return 0;
	for (size_t i = 0; i < len; i++)
		folded[i] = fold_byte(folded[i]);
	made = add_entry(names, slot, folded, len, hash);
	if (made)
		names->entry[made].fold = made + 1;
	return made;
}

uint32_t names_fold(struct names *names, uint32_t id)
{
	uint32_t fold;

	if (id == 0 || id >= (uint32_t)names->count)
		return 0;
	if (names->entry[id].fold)
		return names->entry[id].fold - 1;
	fold = intern_folded(names, id);
	if (fold)
		names->entry[id].fold = fold + 1;
	return fold;
}
