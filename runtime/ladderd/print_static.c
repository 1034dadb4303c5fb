/* SPDX-License-Identifier: MIT
 *
 * print_static - printf() of a static ladderd: the linker replaces that of the C library, which
 * prints floating point and is six times as large.
 *
 * It knows what messages use: `d i u x X o c s %`, the flags `-` and `0`, width, precision of a
 * text, and `hh h l ll z`. REAL values are printed by base/decimal.c.
 */
#include <stdarg.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

int __wrap_vsnprintf(char *text, size_t size, const char *format, va_list args);
int __wrap_snprintf(char *text, size_t size, const char *format, ...);
int __wrap_vfprintf(FILE *file, const char *format, va_list args);
int __wrap_fprintf(FILE *file, const char *format, ...);
int __wrap_printf(const char *format, ...);

struct out {
	FILE *file;            /* NULL: bytes beyond the room are only counted */
	char *text;
	size_t room, used;
	int len;               /* of the whole text; -1: the file failed       */
};

struct field {
	bool left, zero;
	int width, precision;  /* precision -1: none                          */
	int longs;             /* of the length; 1: as `l` and `z`            */
};

static void flush(struct out *out)
{
	if (fwrite(out->text, 1, out->used, out->file) != out->used)
		out->len = -1;
	out->used = 0;
}

static void put(struct out *out, char c)
{
	if (out->file && out->used == out->room)
		flush(out);
	if (out->used < out->room)
		out->text[out->used++] = c;
	if (out->len >= 0)
		out->len++;
}

static void put_field(struct out *out, const struct field *field, const char *text, size_t len)
{
	int blanks = field->width - (int)len;

	for (; !field->left && blanks > 0; blanks--)
		put(out, ' ');
	while (len--)
		put(out, *text++);
	for (; blanks > 0; blanks--)
		put(out, ' ');
}

static void put_number(struct out *out, const struct field *field, uint64_t value, unsigned base,
		       bool minus, char ten)
{
	char digits[72];
	const int most = (int)sizeof(digits) - 1;
	int count = 0, least = field->precision >= 0 ? field->precision : 1;

	if (field->zero && !field->left && field->precision < 0)
		least = field->width - minus;
	for (; count < most && (value || count < least || !count); value /= base) {
		const unsigned digit = (unsigned)(value % base);

		digits[most - count++] = (char)(digit < 10 ? '0' + digit : ten + digit - 10);
	}
	if (minus)
		digits[most - count++] = '-';
	put_field(out, field, digits + most + 1 - count, (size_t)count);
}

static void put_text(struct out *out, const struct field *field, const char *text)
{
	size_t len = 0;

	while ((field->precision < 0 || len < (size_t)field->precision) && text[len])
		len++;
	put_field(out, field, text, len);
}

/* A width or a precision. Its numbers are below 1000. */
static int take_size(const char **at, va_list *args)
{
	int size = 0;

	if (**at == '*') {
		++*at;
		return va_arg(*args, int);
	}
	for (; **at >= '0' && **at <= '9'; ++*at)
		size = size * 10 + **at - '0';
	return size;
}

static struct field take_field(const char **at, va_list *args)
{
	struct field field = { .precision = -1 };

	for (; **at == '-' || **at == '0'; ++*at)
		*(**at == '-' ? &field.left : &field.zero) = true;
	field.width = take_size(at, args);
	if (**at == '.') {
		++*at;
		field.precision = take_size(at, args);
	}
	for (; **at == 'l' || **at == 'h' || **at == 'z'; ++*at)
		field.longs += **at != 'h';
	return field;
}

static uint64_t take_unsigned(const struct field *field, va_list *args)
{
	return field->longs == 0 ? va_arg(*args, unsigned) :
	       field->longs == 1 ? va_arg(*args, unsigned long) : va_arg(*args, unsigned long long);
}

static int64_t take_signed(const struct field *field, va_list *args)
{
	return field->longs == 0 ? va_arg(*args, int) :
	       field->longs == 1 ? va_arg(*args, long) : va_arg(*args, long long);
}

static void put_one(struct out *out, char kind, const struct field *field, va_list *args)
{
	int64_t number;
	char one;

	switch (kind) {
	case 'd': case 'i':
		number = take_signed(field, args);
		put_number(out, field, number < 0 ? 0 - (uint64_t)number : (uint64_t)number, 10,
			   number < 0, 'a');
		break;
	case 'u':
		put_number(out, field, take_unsigned(field, args), 10, false, 'a');
		break;
	case 'o':
		put_number(out, field, take_unsigned(field, args), 8, false, 'a');
		break;
	case 'x': case 'X':
		put_number(out, field, take_unsigned(field, args), 16, false,
			   (char)(kind - 'x' + 'a'));
		break;
	case 's':
		put_text(out, field, va_arg(*args, const char *));
		break;
	case 'c':
		one = (char)va_arg(*args, int);
		put_field(out, field, &one, 1);
		break;
	default: /* of `%%` the second one */
		put(out, kind);
	}
}

static int print(struct out *out, const char *at, va_list given)
{
	va_list args;

	va_copy(args, given);
	while (*at) {
		struct field field;

		if (*at != '%') {
			put(out, *at++);
			continue;
		}
		at++;
		field = take_field(&at, &args);
		if (*at)
			put_one(out, *at++, &field, &args);
	}
	va_end(args);
	return out->len;
}

int __wrap_vsnprintf(char *text, size_t size, const char *format, va_list args)
{
	struct out out = { .text = text, .room = size ? size - 1 : 0 };

	print(&out, format, args);
	if (size)
		text[out.used] = '\0';
	return out.len;
}

int __wrap_snprintf(char *text, size_t size, const char *format, ...)
{
	va_list args;
	int len;

	va_start(args, format);
	len = __wrap_vsnprintf(text, size, format, args);
	va_end(args);
	return len;
}

int __wrap_vfprintf(FILE *file, const char *format, va_list args)
{
	char text[256];
	struct out out = { .file = file, .text = text, .room = sizeof(text) };

	print(&out, format, args);
	flush(&out);
	return out.len;
}

int __wrap_fprintf(FILE *file, const char *format, ...)
{
	va_list args;
	int len;

	va_start(args, format);
	len = __wrap_vfprintf(file, format, args);
	va_end(args);
	return len;
}

int __wrap_printf(const char *format, ...)
{
	va_list args;
	int len;

	va_start(args, format);
	len = __wrap_vfprintf(stdout, format, args);
	va_end(args);
	return len;
}
