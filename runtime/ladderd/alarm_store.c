/* SPDX-License-Identifier: MIT
 *
 * alarm_store - row i lies in records 2 i and 2 i + 1; the newer one that is whole counts.
 */
#include "ladderd/alarm_store.h"

#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

static off_t place(uint32_t row, uint32_t version)
{
	return (off_t)(2 * row + version % 2) * (off_t)ALARM_BYTES;
}

/* Returns whether a row was there that cannot be read any more. */
static bool load_row(struct alarm_store *store, struct alarm_list *list, uint32_t i)
{
	bool damaged = false, found = false, empty;

	for (uint32_t k = 0; k < 2; k++) {
		struct alarm_row row;
		uint32_t version;

		if (pread(store->fd, store->bytes, ALARM_BYTES, place(i, k)) != (ssize_t)ALARM_BYTES)
			continue;
		if (!alarm_open(store->bytes, &row, &version, &empty)) {
			damaged |= !empty;
			continue;
		}
		if (found && version < store->version[i])
			continue;
		found = true;
		store->version[i] = version;
		list->row[i] = row;
		if (row.number > list->last)
			list->last = row.number;
	}
	return damaged && !found;
}

void alarm_store_open(struct alarm_store *store, const char *folder, struct alarm_list *list,
		      int64_t now_ns)
{
	char path[512];
	bool damaged = false;

	store->fd = -1;
	store->written_ns = INT64_MIN / 2;
	if (!folder)
		return;
	if (snprintf(path, sizeof(path), "%s/alarms", folder) < (int)sizeof(path))
		store->fd = open(path, O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0640);
	if (store->fd < 0) {
		fprintf(stderr, "ladderd: %s/alarms: %s; alarms are not stored\n", folder,
			strerror(errno));
		return;
	}
	for (uint32_t i = 0; i < ALARM_ROWS; i++)
		damaged |= load_row(store, list, i);
	alarm_list_doubt(list, true);
	if (!damaged)
		return;
	fprintf(stderr, "ladderd: %s: rows are damaged and are lost\n", path);
	alarm_list_raise(list, ALARM_DAMAGED, true, now_ns);
	alarm_list_raise(list, ALARM_DAMAGED, false, now_ns);
}

static bool write_row(struct alarm_store *store, const struct alarm_list *list, uint32_t i)
{
	const uint32_t version = store->version[i] + 1;

	alarm_seal(&list->row[i], version, store->bytes);
	if (pwrite(store->fd, store->bytes, ALARM_BYTES, place(i, version)) !=
	    (ssize_t)ALARM_BYTES)
		return false;
	store->version[i] = version;
	return true;
}

static void write_all(struct alarm_store *store, struct alarm_list *list)
{
	bool good = true;

	for (uint32_t i = 0; i < ALARM_ROWS && store->fd >= 0; i++) {
		if (!list->dirty[i])
			continue;
		list->dirty[i] = !write_row(store, list, i);
		good &= !list->dirty[i];
	}
	good = good && (store->fd < 0 || fdatasync(store->fd) == 0);
	if (!good && !store->failing)
		fprintf(stderr, "ladderd: alarms are not stored: %s\n", strerror(errno));
	store->failing = !good;
	list->changed = !good;
}

void alarm_store_write(struct alarm_store *store, struct alarm_list *list, int64_t now_ns)
{
	if (!list->changed || now_ns - store->written_ns < ALARM_STORE_NS)
		return;
	store->written_ns = now_ns;
	write_all(store, list);
}

void alarm_store_close(struct alarm_store *store, struct alarm_list *list)
{
	if (list->changed)
		write_all(store, list);
	if (store->fd >= 0)
		close(store->fd);
	store->fd = -1;
}
