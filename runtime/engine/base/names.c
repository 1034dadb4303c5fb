/* SPDX-License-Identifier: MIT
 *
 * names - every string of a project, stored once and known by a number.
 *
 * An open hash of ids, at most half full. Strings are never removed.
 */
#include "engine/base/names.h"
#include "engine/base/name.h"

#include <string.h>

struct names_entry {
	const char *text;
	uint32_t len;
	uint32_t hash; /* the same for all spellings                          */
	uint32_t fold; /* the id of its first spelling                        */
};

#define FIRST_SLOTS 256u

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
	*empty = (struct names_entry){ .text = "" };
}

/* The slot of a string, or the free one where it belongs. Its other spellings lie
 * before that slot, older ids first. @fold gets the oldest, or 0. */
static uint32_t find_slot(const struct names *names, const char *text, size_t len,
			  uint32_t hash, uint32_t *fold)
{
	uint32_t at = hash & names->mask;

	*fold = 0;
	for (; names->slot[at]; at = (at + 1) & names->mask) {
		const struct names_entry *entry =
			&names->entry[names->slot[at]];

		if (entry->hash != hash)
			continue;
		if (entry->len == len && memcmp(entry->text, text, len) == 0)
			break;
		if (!*fold && name_same(entry->text, entry->len, text, len))
			*fold = names->slot[at];
	}
	return at;
}

/* In the order of the ids, which find_slot() needs. */
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

static bool has_room(struct names *names)
{
	return (uint32_t)names->count * 2 <= names->mask || double_slots(names);
}

uint32_t names_intern(struct names *names, const char *text, size_t len)
{
	struct names_entry *entry;
	uint32_t hash, slot, fold;
	const char *copy;

	if (len == 0 || len >= UINT32_MAX || !names->count || !has_room(names))
		return 0;
	hash = name_hash(text, len);
	slot = find_slot(names, text, len, hash, &fold);
	if (names->slot[slot])
		return names->slot[slot];
	copy = arena_copy(names->arena, text, len);
	if (!copy)
		return 0;
	entry = arena_push(names->arena, &names->entry, &names->count,
			   sizeof(*entry));
	if (!entry)
		return 0;
	names->slot[slot] = (uint32_t)names->count - 1;
	*entry = (struct names_entry){
		.text = copy, .len = (uint32_t)len, .hash = hash,
		.fold = fold ? fold : names->slot[slot],
	};
	return names->slot[slot];
}

uint32_t names_find(const struct names *names, const char *text, size_t len)
{
	uint32_t fold;

	if (len == 0 || len >= UINT32_MAX || !names->count)
		return 0;
	return names->slot[find_slot(names, text, len, name_hash(text, len),
				     &fold)];
}

uint32_t names_find_any(const struct names *names, const char *text, size_t len)
{
	uint32_t fold, slot;

	if (len == 0 || len >= UINT32_MAX || !names->count)
		return 0;
	slot = find_slot(names, text, len, name_hash(text, len), &fold);
	return fold ? fold : names_fold(names, names->slot[slot]);
}

const char *names_text(const struct names *names, uint32_t id)
{
	return id < (uint32_t)names->count ? names->entry[id].text : "";
}

size_t names_len(const struct names *names, uint32_t id)
{
	return id < (uint32_t)names->count ? names->entry[id].len : 0;
}

uint32_t names_fold(const struct names *names, uint32_t id)
{
	return id < (uint32_t)names->count ? names->entry[id].fold : 0;
}
