/* SPDX-License-Identifier: MIT
 *
 * text - see text.h. A text that is too long is clipped; it always ends with a NUL.
 */
#include "guard/text.h"

#include <stdarg.h>
#include <stdbool.h>
#include <stdint.h>
#include <string.h>
#include <unistd.h>

#define NUMBER_MOST 2000000000

struct out {
	char *text;
	size_t size, len; /* len: of the whole text                          */
};

static void put(struct out *out, const char *text, size_t len)
{
	for (; len > 0; len--, text++, out->len++)
		if (out->len + 1 < out->size)
			out->text[out->len] = *text;
}

static void put_number(struct out *out, unsigned long long value, bool negative)
{
	char digits[24];
	size_t at = sizeof(digits);

	do {
		digits[--at] = (char)('0' + value % 10);
		value /= 10;
	} while (value);
	if (negative)
		digits[--at] = '-';
	put(out, digits + at, sizeof(digits) - at);
}

static void put_signed(struct out *out, long long value)
{
	put_number(out, value < 0 ? 0 - (unsigned long long)value : (unsigned long long)value, value < 0);
}

static void print(struct out *out, const char *format, va_list *args)
{
	for (const char *at = format; *at; at++) {
		size_t most = SIZE_MAX;

		if (*at != '%') {
			put(out, at, 1);
			continue;
		}
		if (strncmp(++at, ".*", 2) == 0) {
			most = (size_t)va_arg(*args, int);
			at += 2;
		}
		if (*at == 'd') {
			put_signed(out, va_arg(*args, int));
		} else if (*at == 'u') {
			put_number(out, va_arg(*args, unsigned), false);
		} else if (*at == 'l') {
			put_signed(out, va_arg(*args, long long));
			at += 2;
		} else {
			const char *text = va_arg(*args, const char *);

			put(out, text, strnlen(text, most));
		}
	}
	if (out->size)
		out->text[out->len < out->size ? out->len : out->size - 1] = '\0';
}

int text_print(char *text, size_t size, const char *format, ...)
{
	struct out out = { text, size, 0 };
	va_list args;

	va_start(args, format);
	print(&out, format, &args);
	va_end(args);
	return (int)out.len;
}

void text_say(const char *format, ...)
{
	static const char head[] = "ladder-guard: ";
	char text[500];
	struct out out = { text, sizeof(text) - 1, 0 };
	va_list args;
	size_t len;

	put(&out, head, sizeof(head) - 1);
	va_start(args, format);
	print(&out, format, &args);
	va_end(args);
	len = strlen(text);
	text[len++] = '\n';
	if (write(STDERR_FILENO, text, len) < 0)
		return; /* nobody is left who could read it */
}

long long text_number(const char *text)
{
	long long value = 0;

	for (const char *at = text; *at; at++) {
		if (*at < '0' || *at > '9')
			return -1;
		value = value * 10 + (*at - '0');
		if (value > NUMBER_MOST)
			return -1;
	}
	return *text ? value : -1;
}
