/* SPDX-License-Identifier: MIT
 *
 * alarm_store - row i lies in records 2 i and 2 i + 1; the newer one that is whole counts.
 */
#include "ladderd/alarm_store.h"
#include "ladderd/disk.h"

#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

static int64_t clock_now(void)
{
	struct timespec now;

	clock_gettime(CLOCK_REALTIME, &now);
	return now.tv_sec * INT64_C(1000000000) + now.tv_nsec;
}

static off_t place(uint32_t row, uint32_t version)
{
	return (off_t)(2 * row + version % 2) * (off_t)ALARM_BYTES;
}

/* Tells it once. */
static void fail(struct alarm_store *store, int error)
{
	if (!store->error)
		fprintf(stderr, "ladderd: %s/alarms: %s; alarms are not stored; %s\n", store->folder,
			strerror(error), disk_hint(error));
	store->error = error;
}

/* A disk that fails once is asked again. */
static ssize_t read_some(struct alarm_store *store, int fd, uint32_t first, uint32_t count)
{
	uint8_t *to = store->bytes + first % ALARM_PIECE * ALARM_BYTES;
	ssize_t got = -1;

	for (int tries = 0; got < 0 && tries < 2; tries++)
		got = pread(fd, to, count * ALARM_BYTES, (off_t)first * (off_t)ALARM_BYTES);
	return got;
}

/* Records from @first on: zeros where the file has none; one that cannot be read is damaged. If the
 * piece cannot be read, those that can be are. */
static void read_piece(struct alarm_store *store, int fd, uint32_t first)
{
	ssize_t got;

	memset(store->bytes, 0, sizeof(store->bytes));
	got = read_some(store, fd, first, ALARM_PIECE);
	if (got >= 0) /* a record that the file ends in was never complete */
		memset(store->bytes + got - got % (ssize_t)ALARM_BYTES, 0,
		       (size_t)(got % (ssize_t)ALARM_BYTES));
	for (uint32_t i = 0; got < 0 && i < ALARM_PIECE; i++) {
		const ssize_t one = read_some(store, fd, first + i, 1);

		if (one != (ssize_t)ALARM_BYTES)
			memset(store->bytes + i * ALARM_BYTES, one < 0 ? 0xff : 0, ALARM_BYTES);
	}
}

/* The newer record of row @i. Returns whether a row was there that cannot be read any more. */
static bool load_row(struct alarm_store *store, int fd, uint32_t i, struct alarm_row *out)
{
	bool damaged = false, empty;

	if (2 * i % ALARM_PIECE == 0)
		read_piece(store, fd, 2 * i);
	out->number = 0;
	for (uint32_t k = 2 * i; k < 2 * i + 2; k++) {
		struct alarm_row row;
		uint32_t version;

		if (!alarm_open(store->bytes + k % ALARM_PIECE * ALARM_BYTES, &row, &version, &empty)) {
			damaged |= !empty;
			continue;
		}
		if (out->number && version < store->version[i])
			continue;
		store->version[i] = version;
		*out = row;
	}
	return damaged && !out->number;
}

/* Row @i came before the file could be read: it gives way to that of the file. */
static void move_row(struct alarm_list *list, uint32_t i)
{
	uint32_t to = ALARM_ROWS - 1;

	while (to > i && list->row[to].number)
		to--;
	if (to == i) {
		list->lost++;
		return;
	}
	list->row[to] = list->row[i];
	list->dirty[to] = true;
}

/* Rows that came before have their numbers behind those of the file. */
static void load(struct alarm_store *store, int fd, struct alarm_list *list, int64_t now_ns)
{
	bool damaged = false;
	uint32_t last = 0;

	for (uint32_t i = 0; i < ALARM_ROWS; i++) {
		struct alarm_row row;

		damaged |= load_row(store, fd, i, &row);
		if (!row.number)
			continue;
		if (list->row[i].number)
			move_row(list, i);
		list->row[i] = row;
		list->dirty[i] = false;
		last = row.number > last ? row.number : last;
	}
	for (uint32_t i = 0; i < ALARM_ROWS; i++)
		if (list->dirty[i])
			list->row[i].number += last;
	list->last += last;
	if (!damaged)
		return;
	fprintf(stderr, "ladderd: %s/alarms: rows are damaged and are lost\n", store->folder);
	alarm_list_raise(list, ALARM_DAMAGED, true, now_ns);
	alarm_list_raise(list, ALARM_DAMAGED, false, now_ns);
}

static int open_file(const struct alarm_store *store, int flags)
{
	char path[512];

	if (snprintf(path, sizeof(path), "%s/alarms", store->folder) >= (int)sizeof(path)) {
		errno = ENAMETOOLONG;
		return -1;
	}
	return open(path, flags | O_CLOEXEC | O_NOFOLLOW, 0640);
}

void alarm_store_open(struct alarm_store *store, const char *folder, struct alarm_list *list,
		      int64_t now_ns)
{
	int fd;

	store->fd = -1;
	store->written_ns = INT64_MIN / 2;
	store->folder = folder;
	if (!folder)
		return;
	for (int tries = 0; store->fd < 0 && tries < 2; tries++)
		store->fd = open_file(store, O_RDWR | O_CREAT);
	fd = store->fd;
	if (fd < 0) {
		fail(store, errno);
		fd = open_file(store, O_RDONLY); /* what stands in it can be read all the same */
		store->unread = fd < 0 && errno != ENOENT;
	}
	if (fd < 0)
		return;
	load(store, fd, list, now_ns);
	alarm_list_doubt(list, true);
	if (fd != store->fd)
		close(fd);
}

/* Again, with what came meanwhile. */
static int open_again(struct alarm_store *store, struct alarm_list *list, int64_t now_ns)
{
	store->fd = open_file(store, O_RDWR | O_CREAT);
	if (store->fd < 0)
		return errno;
	if (store->unread)
		load(store, store->fd, list, now_ns);
	store->unread = false;
	return 0;
}

static int write_rows(struct alarm_store *store, const struct alarm_list *list)
{
	int error = 0;

	for (uint32_t i = 0; i < ALARM_ROWS && !error; i++) {
		const uint32_t version = store->version[i] + 1;

		if (!list->dirty[i])
			continue;
		alarm_seal(&list->row[i], version, store->bytes);
		error = -disk_write(store->fd, store->bytes, ALARM_BYTES, place(i, version));
	}
	return !error && fdatasync(store->fd) != 0 ? errno : error;
}

/* Until the disk has said that it has all of them, rows go to the same places again: the kernel
 * may have dropped what it could not write. */
static void write_all(struct alarm_store *store, struct alarm_list *list, int64_t now_ns)
{
	int error = store->fd < 0 ? open_again(store, list, now_ns) : 0;

	if (!error)
		error = write_rows(store, list);
	if (error) {
		fail(store, error);
		return;
	}
	for (uint32_t i = 0; i < ALARM_ROWS; i++)
		store->version[i] += list->dirty[i];
	memset(list->dirty, 0, sizeof(list->dirty));
	list->changed = false;
	if (store->error)
		fputs("ladderd: alarms are stored again\n", stderr);
	store->error = 0;
}

void alarm_store_write(struct alarm_store *store, struct alarm_list *list, int64_t now_ns)
{
	if (!store->folder || !(list->changed || store->error) ||
	    now_ns - store->written_ns < ALARM_STORE_NS)
		return;
	store->written_ns = now_ns;
	write_all(store, list, clock_now());
}

void alarm_store_close(struct alarm_store *store, struct alarm_list *list)
{
	if (store->folder && list->changed)
		write_all(store, list, clock_now());
	if (store->fd >= 0)
		close(store->fd);
	store->fd = -1;
}
