/* SPDX-License-Identifier: MIT
 *
 * check - length, magic, kind and the range of each field. A ladderd whose memory is damaged must
 * not lead the guard astray.
 */
#include "guard/check.h"

#include <string.h>

static bool check_table(const struct guard_table *table, size_t len)
{
	const size_t count = table->head.count;

	if (count > GUARD_LINES || len != offsetof(struct guard_table, line) +
					  count * sizeof(table->line[0]) ||
	    table->dev[0] != '/' || !memchr(table->dev, 0, sizeof(table->dev)))
		return false;
	for (size_t i = 0; i < count; i++) {
		const struct guard_line *line = &table->line[i];

		if (line->level > 1 || line->bias > GUARD_THIRD || line->drive > GUARD_THIRD ||
		    line->hold > GUARD_KNOWN)
			return false;
		for (size_t k = 0; k < i; k++)
			if (table->line[k].chip == line->chip &&
			    table->line[k].offset == line->offset)
				return false;
	}
	return true;
}

static bool check_files(const struct guard_files *files, size_t len)
{
	const char *at = files->record, *end = (const char *)files + len;

	if (files->head.count > GUARD_FILES)
		return false;
	for (size_t i = 0; i < files->head.count; i++) {
		const size_t left = (size_t)(end - at);
		const char *path = at + sizeof(int64_t), *nul;

		if (left <= sizeof(int64_t) || *path != '/')
			return false;
		nul = memchr(path, 0, left - sizeof(int64_t));
		if (!nul || nul - path >= GUARD_PATH)
			return false;
		at = nul + 1;
	}
	return at == end;
}

bool guard_check(const union guard_packet *packet, size_t len)
{
	const struct guard_head *head = &packet->head;

	if (len < sizeof(*head) || head->magic != GUARD_MAGIC)
		return false;
	switch (head->kind) {
	case GUARD_BEAT:
		return len == sizeof(*head) && head->within_ms >= 1 &&
		       head->within_ms <= GUARD_LONGEST;
	case GUARD_TABLE:
	case GUARD_MORE:
		return len >= offsetof(struct guard_table, line) &&
		       check_table(&packet->table, len);
	case GUARD_VALUES:
	case GUARD_VALUES_MORE:
		return len >= offsetof(struct guard_files, record) && check_files(&packet->files, len);
	case GUARD_LEVELS:
		return len == sizeof(packet->levels);
	case GUARD_TAKE:
		return len == sizeof(*head);
	case GUARD_TELL:
		return len == sizeof(packet->tell) &&
		       memchr(packet->tell.text, 0, sizeof(packet->tell.text));
	default:
		return false;
	}
}
