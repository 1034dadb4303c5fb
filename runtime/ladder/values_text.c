/* SPDX-License-Identifier: MIT
 *
 * values_text - a line for each value: name, type, `=`, the value or the elements of an array.
 *
 * A value is written as traces show it. One that does not read back exactly so (a NaN) is written as
 * its bits: bits 16#7FC00001.
 */
#include "ladder/values_text.h"

#include "engine/scan/retain.h"
#include "engine/trial/value.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define HEAD  "RUNGBOARD VALUES 1\n"
#define BITS  "bits 16#"

/* "FIFO.DINT[64]": the elementary type, and how many. */
static enum iec_type split_type(const char *type, size_t len, uint32_t *count)
{
	const char *bracket = memchr(type, '[', len);
	const char *end = bracket ? bracket : type + len;
	const char *word = end;

	*count = bracket ? (uint32_t)strtoul(bracket + 1, NULL, 10) : 1;
	while (word > type && word[-1] != '.')
		word--;
	return iec_type_find(word, (size_t)(end - word));
}

/* ---- to text ---- */

static void add_text(struct bytes *out, const char *text)
{
	bytes_add(out, text, strlen(text));
}

static union iec_value load(const uint8_t *bytes, enum iec_type type, uint32_t size,
			    struct iec_text *room)
{
	struct iec_string *text;
	uint16_t length = 0;

	if (type != IEC_STRING)
		return iec_load(bytes, type);
	if (size >= sizeof(*text))
		memcpy(&length, bytes + offsetof(struct iec_string, length), sizeof(length));
	if (length > size - sizeof(*text) || length > IEC_STRING_MOST)
		length = 0;
	text = iec_text_init(room, length);
	memcpy(text->text, bytes + sizeof(*text), length);
	return (union iec_value){ .s = text };
}

/* Whether @text reads back as exactly these bytes. */
static bool reads_back(enum iec_type type, const char *text, const uint8_t *bytes)
{
	uint8_t again[8] = { 0 };
	struct iec_text room;
	union iec_value value;
	enum diag_id why;

	if (!value_parse(type, text, strlen(text), &room, &value, &why))
		return false;
	iec_store(again, type, value);
	return memcmp(again, bytes, iec_type_row(type)->size) == 0;
}

static void print_value(enum iec_type type, const uint8_t *bytes, uint32_t size, struct bytes *out)
{
	char text[IEC_VALUE_TEXT];
	struct iec_text room;
	uint64_t bits = 0;

	iec_value_print(type, load(bytes, type, size, &room), text, sizeof(text));
	if (type != IEC_STRING && !reads_back(type, text, bytes)) {
		memcpy(&bits, bytes, iec_type_row(type)->size);
		snprintf(text, sizeof(text), BITS "%llX", (unsigned long long)bits);
	}
	add_text(out, text);
}

void values_print(const uint8_t *payload, uint32_t len, struct bytes *out)
{
	struct retain_record record;
	uint32_t at = RETAIN_HEAD, count;
	char clock[48];

	snprintf(clock, sizeof(clock), HEAD "clock %lld\n", (long long)retain_clock(payload));
	add_text(out, clock);
	while (retain_next(payload, len, &at, &record)) {
		const enum iec_type type = split_type(record.type, record.type_len, &count);
		const uint32_t size = count ? record.size / count : 0;

		/* The bytes come from a board. */
		if (type == IEC_NONE || !size ||
		    (type != IEC_STRING && size != iec_type_row(type)->size))
			continue;
		bytes_add(out, record.name, record.name_len);
		add_text(out, " ");
		bytes_add(out, record.type, record.type_len);
		for (uint32_t i = 0; i < count; i++) {
			add_text(out, i ? ", " : " = ");
			print_value(type, record.value + i * size, size, out);
		}
		add_text(out, "\n");
	}
}

/* ---- from text ---- */

bool values_is_text(const uint8_t *bytes, size_t len)
{
	return len >= sizeof(HEAD) - 1 && memcmp(bytes, HEAD, sizeof(HEAD) - 1) == 0;
}

static bool take_bits(enum iec_type type, const char *text, size_t len, struct bytes *out)
{
	const size_t skip = sizeof(BITS) - 1;
	uint8_t bytes[8];
	char digits[17];
	uint64_t bits;
	char *end;

	if (type == IEC_STRING || len <= skip || len - skip >= sizeof(digits) ||
	    memcmp(text, BITS, skip) != 0)
		return false;
	memcpy(digits, text + skip, len - skip);
	digits[len - skip] = '\0';
	bits = strtoull(digits, &end, 16);
	memcpy(bytes, &bits, sizeof(bytes));
	bytes_add(out, bytes, iec_type_row(type)->size);
	return !*end;
}

static bool take_value(enum iec_type type, const char *text, size_t len, struct bytes *out)
{
	uint8_t bytes[8] = { 0 };
	struct iec_text room;
	union iec_value value;
	enum diag_id why;

	while (len && text[0] == ' ')
		text++, len--;
	while (len && text[len - 1] == ' ')
		len--;
	if (take_bits(type, text, len, out))
		return true;
	if (!value_parse(type, text, len, &room, &value, &why))
		return false;
	if (type == IEC_STRING) {
		bytes_add(out, value.s, sizeof(*value.s) + value.s->length);
		return true;
	}
	iec_store(bytes, type, value);
	bytes_add(out, bytes, iec_type_row(type)->size);
	return true;
}

/* The values of one line; @count of them. */
static bool take_values(enum iec_type type, uint32_t count, const char *text, size_t len,
			struct bytes *out)
{
	const char *end = text + len;

	if (count == 1)
		return take_value(type, text, len, out);
	for (uint32_t i = 0; i < count; i++) {
		const char *comma = text < end ? memchr(text, ',', (size_t)(end - text)) : NULL;
		const char *stop = comma ? comma : end;

		if (text > end || (i + 1 < count) != (comma != NULL) ||
		    !take_value(type, text, (size_t)(stop - text), out))
			return false;
		text = stop + 1;
	}
	return true;
}

/* A record: the lengths, name, type, value. */
static bool take_line(const char *line, size_t len, struct bytes *out)
{
	const char *space = memchr(line, ' ', len);
	const char *type = space ? space + 1 : line;
	const char *second = space ? memchr(type, ' ', len - (size_t)(type - line)) : NULL;
	const size_t name_len = space ? (size_t)(space - line) : 0;
	const size_t type_len = second ? (size_t)(second - type) : 0;
	const char *value = second ? second + 3 : line;
	const size_t head = out->len;
	uint8_t lengths[RETAIN_RECORD] = { (uint8_t)name_len, (uint8_t)(name_len >> 8), (uint8_t)type_len };
	uint32_t count, size;
	enum iec_type base;

	if (!name_len || !type_len || name_len > UINT16_MAX || type_len > UINT8_MAX ||
	    len < (size_t)(value - line) || memcmp(second, " = ", 3) != 0)
		return false;
	base = split_type(type, type_len, &count);
	if (base == IEC_NONE || !count || count > LIMIT_RETAIN)
		return false;
	bytes_add(out, lengths, sizeof(lengths));
	bytes_add(out, line, name_len);
	bytes_add(out, type, type_len);
	size = (uint32_t)out->len;
	if (!take_values(base, count, value, len - (size_t)(value - line), out) || out->failed)
		return false;
	size = (uint32_t)out->len - size;
	memcpy(out->at + head + 4, &size, sizeof(size));
	return true;
}

static bool take_clock(const char *line, size_t len, struct bytes *payload)
{
	const size_t skip = sizeof("clock ") - 1;
	char digits[24];
	char *end;
	int64_t clock_ns;

	if (len <= skip || len - skip >= sizeof(digits) || memcmp(line, "clock ", skip) != 0)
		return false;
	memcpy(digits, line + skip, len - skip);
	digits[len - skip] = '\0';
	clock_ns = strtoll(digits, &end, 10);
	memcpy(payload->at, &clock_ns, sizeof(clock_ns));
	return !*end;
}

enum status values_parse(const char *path, const char *text, size_t len, struct bytes *payload)
{
	static const uint8_t head[RETAIN_HEAD];
	const char *end = text + len;
	uint32_t count = 0;

	bytes_add(payload, head, sizeof(head));
	for (int number = 1; text < end && !payload->failed; number++) {
		const char *stop = memchr(text, '\n', (size_t)(end - text));
		const size_t line = stop ? (size_t)(stop - text) : (size_t)(end - text);
		bool good = line == 0 || *text == '#';

		if (number == 1)
			good = values_is_text((const uint8_t *)text, (size_t)(end - text));
		else if (number == 2)
			good = take_clock(text, line, payload);
		else if (!good)
			good = take_line(text, line, payload), count += good;
		if (!good) {
			report_diag((struct diag){ .id = DIAG_LINK_BACKUP, .file = path, .line = number },
				    "%.*s", line < 100 ? (int)line : 100, text);
			return STATUS_NO;
		}
		text += line + 1;
	}
	if (payload->failed)
		return report_no_memory(path);
	memcpy(payload->at + 8, &count, sizeof(count));
	return STATUS_GOOD;
}
