/* SPDX-License-Identifier: MIT
 *
 * iec_cases - the lines of iec_cases.txt, each a test.
 *
 *   iec_cases [FILE]
 *
 * It calls the blocks and functions of scan/ directly: without text, translation or
 * image.
 */
#include "engine/scan/vm.h"
#include "tests/tap.h"

#include <ctype.h>
#include <stdlib.h>

/* Room for an instance of any block. */
union instance {
#define FB(id, ...) struct fb_##id id;
#include "engine/catalog.def"
	uint8_t bytes[1];
};

static void call_block(enum word fb, union instance *instance, int64_t now_ns)
{
#define FB(id, ...) if (fb == FB_##id) fb_##id##_step(&instance->id, now_ns);
#include "engine/catalog.def"
}

static enum fn_status call_function(enum word fn, struct fn_args *args)
{
#define FN(id, ...) if (fn == FN_##id) return fn_##id(args);
#include "engine/catalog.def"
	return FN_FAILED;
}

static const char *skip_blanks(const char *at)
{
	return at + strspn(at, " ");
}

/* A whole number, with a unit of time or without. */
static int64_t read_number(const char **at)
{
	static const struct { const char *unit; int64_t ns; } units[] = {
		{ "ns", 1 }, { "us", 1000 }, { "ms", 1000000 },
		{ "s", 1000000000 },
	};
	char *end;
	int64_t value = strtoll(*at, &end, 10);

	*at = end;
	for (int i = 0; i < 4; i++) {
		size_t n = strlen(units[i].unit);

		if (strncmp(*at, units[i].unit, n) == 0 &&
		    !isalpha((unsigned char)(*at)[n])) {
			*at += n;
			return value * units[i].ns;
		}
	}
	return value;
}

/* `PIN=VALUE` at *@at; false: there is none. */
static bool read_pin(const char **at, const struct word_row *row,
		     const struct word_pin **pin, int64_t *value)
{
	const char *text = skip_blanks(*at);
	size_t len = strcspn(text, "=;|> \n");

	if (text[len] != '=')
		return false;
	*pin = NULL;
	for (int i = 0; i < row->pin_count; i++)
		if (strlen(row->pin[i].name) == len &&
		    strncmp(row->pin[i].name, text, len) == 0)
			*pin = &row->pin[i];
	text += len + 1;
	*value = read_number(&text);
	*at = text;
	return true;
}

static bool pins(const char **at, const struct word_row *row,
		 union instance *instance, bool check)
{
	const struct word_pin *pin;
	int64_t value;
	bool good = true;

	while (read_pin(at, row, &pin, &value)) {
		union iec_value there = { .i = value };

		if (!pin)
			return false;
		if (!check) {
			iec_store(instance->bytes + pin->offset, pin->type,
				  there);
			continue;
		}
		there = iec_load(instance->bytes + pin->offset, pin->type);
		if (there.i == value)
			continue;
		printf("# %s is %lld, should be %lld\n", pin->name,
		       (long long)there.i, (long long)value);
		good = false;
	}
	return good;
}

static bool run_block(const struct word_row *row, enum word fb, const char *at)
{
	union instance instance;
	bool good;

	memset(&instance, 0, sizeof(instance));
	good = pins(&at, row, &instance, false);
	at = skip_blanks(at);
	while (good && (*at == '|' || *at == ';')) {
		int64_t now_ns;

		at = skip_blanks(at + 1);
		now_ns = read_number(&at);
		good = pins(&at, row, &instance, false);
		call_block(fb, &instance, 1000000 + now_ns);
		at = skip_blanks(at);
		if (*at == '>') {
			at++;
			good &= pins(&at, row, &instance, true);
		}
		at = skip_blanks(at);
	}
	return good && *at == '\0';
}

static bool run_function(enum word fn, const char *at)
{
	struct fn_args args = { .type = IEC_NONE };
	enum fn_status status, want = FN_OK;
	size_t len = strcspn(at, " ");
	int64_t result;
	uint8_t stored[8];

	args.type = iec_type_find(at, len);
	at = skip_blanks(at + len);
	if (*at++ != '|' || args.type == IEC_NONE)
		return false;
	for (at = skip_blanks(at); *at && *at != '>' &&
	     args.count < LIMIT_FN_ARGS; at = skip_blanks(at))
		args.in[args.count++].i = read_number(&at);
	if (*at++ != '>')
		return false;
	status = call_function(fn, &args);
	at = skip_blanks(at);
	if (strcmp(at, "fails") == 0)
		return status == FN_FAILED;
	result = read_number(&at);
	if (strcmp(skip_blanks(at), "wraps") == 0)
		want = FN_WRAPPED;
	/* Stored and read back: the value in a variable of the type. */
	iec_store(stored, args.type, args.out);
	if (!word_is_test(word_row(fn)))
		args.out = iec_load(stored, args.type);
	if (status != want || args.out.i != result)
		printf("# status %d, should be %d; result %lld, should be %lld\n",
		       (int)status, (int)want, (long long)args.out.i,
		       (long long)result);
	return status == want && args.out.i == result;
}

static void run_line(char *line)
{
	char name[64], text[64];
	const char *at = line;
	enum word word;
	bool good;

	line[strcspn(line, "\n")] = '\0';
	if (*line == '#' || *line == '\0')
		return;
	snprintf(name, sizeof(name), "%.*s", (int)strcspn(at, " "), at);
	at = skip_blanks(at + strcspn(at, " "));
	word = word_find(at, strcspn(at, " "));
	at = skip_blanks(at + strcspn(at, " "));
	if (word == WORD_COUNT)
		good = false;
	else if (word_row(word)->kind == WORD_FB)
		good = run_block(word_row(word), word, at);
	else
		good = run_function(word, at);
	snprintf(text, sizeof(text), "%s", name);
	CHECK_AS(good, text);
}

int main(int argc, char **argv)
{
	FILE *file = fopen(argc > 1 ? argv[1] : "tests/iec_cases.txt", "r");
	char line[1024];

	if (!file) {
		printf("Bail out! cannot read the table\n");
		return 1;
	}
	while (fgets(line, sizeof(line), file))
		run_line(line);
	fclose(file);
	return tap_done();
}
