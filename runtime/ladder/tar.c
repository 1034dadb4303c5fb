/* SPDX-License-Identifier: MIT
 *
 * tar - blocks of 512 bytes: a head, the bytes of the file, zeros. A name that is longer than its
 * field is a file before it, of type L, as GNU tar does it. Archives of the same content are
 * the same bytes: there are no times and no users.
 */
#include "ladder/tar.h"

#include <stdio.h>
#include <string.h>

#define BLOCK 512u
#define NAME  100u
#define SIZE_AT 124u
#define SUM_AT  148u
#define TYPE_AT 156u
#define LONG "././@LongLink"

static unsigned sum_of(const uint8_t *head)
{
	unsigned sum = 0;

	for (unsigned i = 0; i < BLOCK; i++)
		sum += i >= SUM_AT && i < SUM_AT + 8 ? ' ' : head[i];
	return sum;
}

static void add_entry(struct bytes *archive, const char *name, char type, const void *bytes,
		      size_t len)
{
	static const uint8_t zeros[BLOCK];
	uint8_t head[BLOCK] = { 0 };
	char field[16];
	const size_t name_len = strlen(name);

	memcpy(head, name, name_len < NAME ? name_len : NAME);
	memcpy(head + 100, "0000644\0" "0000000\0" "0000000", 24);
	snprintf(field, sizeof(field), "%011zo", len);
	memcpy(head + SIZE_AT, field, 12);
	memcpy(head + 136, "00000000000", 12);
	head[TYPE_AT] = (uint8_t)type;
	memcpy(head + 257, "ustar\0" "00", 8);
	snprintf(field, sizeof(field), "%06o", sum_of(head));
	memcpy(head + SUM_AT, field, 7);
	head[SUM_AT + 7] = ' ';
	bytes_add(archive, head, BLOCK);
	bytes_add(archive, bytes, len);
	bytes_add(archive, zeros, (BLOCK - len % BLOCK) % BLOCK);
}

void tar_add(struct bytes *archive, const char *name, const void *bytes, size_t len)
{
	if (strlen(name) > NAME)
		add_entry(archive, LONG, 'L', name, strlen(name) + 1);
	add_entry(archive, name, '0', bytes, len);
}

void tar_end(struct bytes *archive)
{
	static const uint8_t zeros[2 * BLOCK];

	bytes_add(archive, zeros, sizeof(zeros));
}

/* An octal number in a field that a blank or NUL ends. */
static bool octal(const uint8_t *field, size_t len, size_t *out)
{
	size_t i = 0;

	while (i < len && field[i] == ' ')
		i++;
	for (*out = 0; i < len && field[i] >= '0' && field[i] <= '7'; i++)
		*out = *out * 8 + (size_t)(field[i] - '0');
	return i == len || field[i] == ' ' || field[i] == '\0';
}

bool tar_is_at_end(const uint8_t *archive, size_t len, size_t at)
{
	if (at > len || len - at < BLOCK)
		return false;
	for (unsigned i = 0; i < BLOCK; i++)
		if (archive[at + i])
			return false;
	return true;
}

/* The head at @at. */
static bool read_head(const uint8_t *archive, size_t len, size_t at, size_t *size)
{
	size_t sum;

	return at <= len && len - at >= BLOCK && !tar_is_at_end(archive, len, at) &&
	       octal(archive + at + SUM_AT, 8, &sum) && sum == sum_of(archive + at) &&
	       octal(archive + at + SIZE_AT, 12, size) && *size <= len - at - BLOCK;
}

/* The prefix field of POSIX, if there is one, and the name. */
static void short_name(const uint8_t *head, struct tar_file *out)
{
	const char *prefix = (const char *)head + 345;
	const bool posix = memcmp(head + 257, "ustar", 6) == 0;

	snprintf(out->name, sizeof(out->name), "%.*s%s%.*s", posix ? 155 : 0, prefix,
		 posix && *prefix ? "/" : "", (int)NAME, (const char *)head);
}

bool tar_next(const uint8_t *archive, size_t len, size_t *at, struct tar_file *out)
{
	bool named = false;
	size_t size;

	while (read_head(archive, len, *at, &size)) {
		const uint8_t *head = archive + *at;
		const size_t blocks = (size + BLOCK - 1) / BLOCK * BLOCK;

		if (blocks > len - *at - BLOCK)
			return false;
		out->bytes = head + BLOCK;
		out->len = size;
		*at += BLOCK + blocks;
		if (head[TYPE_AT] == 'L') {
			if (!size || size > sizeof(out->name))
				return false;
			memcpy(out->name, out->bytes, size);
			out->name[size - 1] = '\0';
			named = true;
			continue;
		}
		if (!named)
			short_name(head, out);
		if (head[TYPE_AT] == '0' || head[TYPE_AT] == '\0')
			return true;
		named = false;
	}
	return false;
}
