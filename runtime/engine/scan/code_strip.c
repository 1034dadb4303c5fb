/* SPDX-License-Identifier: MIT
 *
 * code_strip - removes the maps that a small target does not need: the watched section,
 * names, power of cells, places.
 *
 * Instructions and identity stay the same. Faults then have no rung.
 */
#include "engine/scan/code.h"

#include "engine/base/digest.h"

#include <string.h>

static size_t padded(size_t size)
{
	return (size + 7) / 8 * 8;
}

size_t code_strip(const void *image, void *out)
{
	const struct code_header *from = image;
	struct code_header *to = out;
	size_t size = sizeof(*from), covered = offsetof(struct code_header, crc) + 4;
	struct code_program *entry;
	struct code_task *task;

	for (int i = 1; i < CODE_WATCH; i++)
		size += padded(from->section[i].size);
	if (!out)
		return size;
	memset(out, 0, size);
	memcpy(to, from, sizeof(*to));
	memset(to->section, 0, sizeof(to->section));
	size = sizeof(*to);
	for (int i = 1; i < CODE_SECTION_COUNT; i++) {
		to->section[i].offset = (uint32_t)size;
		if (i >= CODE_WATCH)
			continue;
		to->section[i].size = from->section[i].size;
		memcpy((uint8_t *)out + size,
		       (const uint8_t *)image + from->section[i].offset,
		       from->section[i].size);
		size += padded(from->section[i].size);
	}
	entry = (void *)((uint8_t *)out + to->section[CODE_PROGRAMS].offset);
	for (size_t i = 0; i < to->section[CODE_PROGRAMS].size / sizeof(*entry); i++)
		entry[i].watch = entry[i].watch_words = entry[i].name = 0;
	task = (void *)((uint8_t *)out + to->section[CODE_TASKS].offset);
	for (size_t i = 0; i < to->section[CODE_TASKS].size / sizeof(*task); i++)
		task[i].name = 0;
	to->size = (uint32_t)size;
	to->crc = digest_crc32c(0, (const uint8_t *)out + covered,
				size - covered);
	return size;
}
