/* SPDX-License-Identifier: MIT
 *
 * test_plain_map_words - walks hal/map_words.def: the reader of maps and the editor's table know the same words.
 * A word that is forgotten in one of them fails here.
 */
#include "editor-gtk/document/iomap_text.h"

#include "hal/channel.h"
#include "hal/drivers.h"
#include "hal/iomap.h"
#include "hal/map_words.h"

#include "tests/tap.h"

#include <stdlib.h>
#include <string.h>

static const struct word_row { const char *name; enum io_word word; bool has_value; } words[] = {
#define MAP_WORD(id, text, has_value) { text, IO_WORD_##id, has_value },
#define MAP_ALSO(id, text, has_value) { text, IO_WORD_##id, has_value },
#include "hal/map_words.def"
};

/* Each place where the reader knows a word. */
static const struct use_row {
	const char *name, *form;
	enum io_word word;
	enum io_kind kind;
	unsigned drivers;  /* of a point                                      */
	unsigned buses;    /* of a BUS or SERVE                               */
	enum option_for use;
} uses[] = {
#define CHIP_OPTION(id, text, use, has_value, form, set) \
	{ text, form, IO_WORD_##id, IO_KIND_POINT, ON_GPIO, 0, use },
#define VALUE_OPTION(id, text, drivers, use, form, set) { text, form, IO_WORD_##id, IO_KIND_POINT, drivers, 0, use },
#define BUS_OPTION(id, text, buses, servers, form, set) \
	{ text, form, IO_WORD_##id, IO_KIND_BUS, 0, buses, FOR_BOTH }, \
	{ text, form, IO_WORD_##id, IO_KIND_SERVE, 0, servers, FOR_BOTH },
#define PUBLISH_OPTION(id, text, form, set) { text, form, IO_WORD_##id, IO_KIND_PUBLISH, 0, 0, FOR_BOTH },
#define MODULE_OPTION(id, text, table) { text, text "=1", IO_WORD_##id, IO_KIND_MODULE, 0, 0, FOR_BOTH },
#define TABLE_WORD(id, text, of_bits) \
	{ text, text "=5", IO_WORD_##id, IO_KIND_MODULE, 0, 0, FOR_BOTH }, \
	{ text, text "=5", IO_WORD_##id, IO_KIND_WINDOW, 0, 0, FOR_BOTH },
#define ACCESS_WORD(text, writable) { text, text, IO_WORD_ACCESS, IO_KIND_WINDOW, 0, 0, FOR_BOTH },
#define DEVICE_OPTION(id, text, form, most, least, member) { text, form, IO_WORD_##id, IO_KIND_DEVICE, 0, 0, FOR_BOTH },
#define DEVICE_ORDER(id, text, form, member) { text, form, IO_WORD_##id, IO_KIND_DEVICE, 0, 0, FOR_BOTH },
#define DEVICE_FLAG(id, text, member) { text, text, IO_WORD_##id, IO_KIND_DEVICE, 0, 0, FOR_BOTH },
#include "hal/map_words.def"
};

/* A row for each use has a word of the list, spelled in the same way, with a value or without. */
static void spelled(void)
{
	for (size_t i = 0; i < sizeof(uses) / sizeof(*uses); i++) {
		const size_t len = strlen(uses[i].name);
		const struct word_row *word = words, *end = words + sizeof(words) / sizeof(*words);

		while (word < end && strcmp(word->name, uses[i].name) != 0)
			word++;
		CHECK(word < end && word->word == uses[i].word);
		CHECK(strncmp(uses[i].form, uses[i].name, len) == 0 && (uses[i].form[len] == '=') == word->has_value);
		CHECK(io_word_find(uses[i].form, strcspn(uses[i].form, " ,")) == uses[i].word);
	}
	for (size_t i = 0; i < sizeof(words) / sizeof(*words); i++) {
		bool used = false;

		for (size_t k = 0; k < sizeof(uses) / sizeof(*uses); k++)
			used = used || strcmp(words[i].name, uses[k].name) == 0;
		CHECK(used);
	}
}

static bool shows(enum io_kind kind, enum io_field field, enum io_word word)
{
	const enum io_word *of = io_field_words(kind, field);

	while (*of != IO_WORDS && *of != word)
		of++;
	return *of != IO_WORDS;
}

/* A line of the map that has the option; chip= and offset= of a chip are one field. */
static void spell_line(const struct use_row *use, unsigned bit, char *out, size_t size)
{
	static const char *const bus[] = { "modbus-rtu", "modbus-tcp", "peer" };
	const size_t len = strcspn(use->form, " ,");
	const char *rest = strncmp(use->form + len, " at ", 4) == 0 ? use->form + len : "";
	const char *at = *rest ? rest : "";

	switch (use->kind) {
	case IO_KIND_POINT:
		if (bit == DRIVER_gpio && (use->word == IO_WORD_CHIP || use->word == IO_WORD_OFFSET)) {
			snprintf(out, size, "%%IX0.0 gpio chip=gpiochip0 offset=17");
			break;
		}
		snprintf(out, size, "%%%s0 %s %.*s%s", use->use == FOR_OUTPUT ? "AQW" : "AIW",
			 driver_row((enum driver_id)bit)->word, (int)len, use->form, at);
		break;
	case IO_KIND_BUS: case IO_KIND_SERVE:
		snprintf(out, size, "%s x %s %.*s", io_kind_word(use->kind), bus[bit], (int)len, use->form);
		break;
	case IO_KIND_WINDOW: case IO_KIND_PUBLISH: case IO_KIND_MODULE: case IO_KIND_DEVICE: case IO_KINDS:
		snprintf(out, size, "%s x %.*s", io_kind_word(use->kind), (int)len, use->form);
		break;
	}
}

/* Whether the reader says of the text that it does not know an option. */
static bool reader_knows(const char *text)
{
	static const enum diag_id strange[] = { DIAG_IO_OPTION, DIAG_IO_CHANNEL_OPTION, DIAG_IO_BUS_OPTION };
	struct diag_list *diags = calloc(1, sizeof(*diags));
	struct arena arena;
	struct iomap map;
	char whole[256];
	bool good = true;

	snprintf(whole, sizeof(whole), "BOARD \"x\"\n%s\n", text);
	arena_init(&arena);
	diag_init(diags);
	iomap_read(&map, &arena, "x.io", whole, strlen(whole), diags);
	for (int i = 0; i < diags->count; i++)
		for (size_t k = 0; k < sizeof(strange) / sizeof(*strange); k++)
			good = good && diags->diag[i].id != strange[k];
	arena_free(&arena);
	free(diags);
	return good;
}

/* A field of the editor shows the value, and sets it again in the same words. */
static bool editor_shows(const char *text, const struct use_row *use)
{
	struct io_text io;
	bool shown = false;

	io_text_read(&io, text, strlen(text));
	for (int f = IO_ADDRESS + 1; f < IO_FIELDS && io.count == 1; f++) {
		const enum io_field field = (enum io_field)f;
		struct io_edit edit = { 0, 0, NULL }, back = { 0, 0, NULL };
		struct io_text other;
		char without[256], *value, *now = NULL;

		if (!shows(use->kind, field, use->word) || !io_text_has(&io, 0, field))
			continue;
		value = io_text_field(&io, 0, field);
		if (*value && io_text_set(&io, 0, field, "", &edit) == IO_GOOD) {
			snprintf(without, sizeof(without), "%.*s%s%s", (int)edit.at, text, edit.with,
				 text + edit.at + edit.removed);
			io_text_read(&other, without, strlen(without));
			if (other.count == 1 && io_text_has(&other, 0, field) &&
			    io_text_set(&other, 0, field, value, &back) == IO_GOOD) {
				now = malloc(512);
				snprintf(now, 512, "%.*s%s%s", (int)back.at, without, back.with,
					 without + back.at + back.removed);
			}
			io_text_free(&other);
			shown = shown || (now && strcmp(now, text) == 0);
		}
		free(now);
		free(back.with);
		free(edit.with);
		free(value);
	}
	io_text_free(&io);
	return shown;
}

/* TABLE_WORD of a point: the number is a field of its own, and does not go alone. */
static bool is_number(const struct use_row *use)
{
	return use->word >= IO_WORD_COIL && use->word <= IO_WORD_HOLDING_REGISTER && use->kind != IO_KIND_MODULE;
}

static void both(void)
{
	char text[128];
	int lines = 0;

	for (size_t i = 0; i < sizeof(uses) / sizeof(*uses); i++)
		for (unsigned bit = 0; bit < DRIVER_COUNT; bit++) {
			const struct use_row *use = &uses[i];
			const unsigned of = use->kind == IO_KIND_POINT ? use->drivers :
				use->kind == IO_KIND_BUS || use->kind == IO_KIND_SERVE ? use->buses : 1;

			if (!(of >> bit & 1))
				continue;
			spell_line(use, bit, text, sizeof(text));
			lines++;
			if (use->kind != IO_KIND_WINDOW && !CHECK(reader_knows(text)))
				printf("# reader: %s\n", text);
			if (!is_number(use) && !CHECK(editor_shows(text, use)))
				printf("# table: %s\n", text);
		}
	printf("# %d lines\n", lines);
	CHECK(!reader_knows("%AIW0 iio nothing=1") && !reader_knows("BUS x peer baud=9600") &&
	      !reader_knows("%IX0.0 gpio refresh=1s"));
}

/* The reader asks drivers.def, the table too: "quality" has its own options there. */
static void quality(void)
{
	static const char text[] = "%IB201 quality of=%XIB0..2";
	struct io_text io;
	char *value;

	io_text_read(&io, text, strlen(text));
	value = io_text_field(&io, 0, IO_OF);
	CHECK_TEXT(value, "%XIB0..2");
	CHECK(!io_text_has(&io, 0, IO_LINE) && !io_text_has(&io, 0, IO_PULL) && !io_text_has(&io, 0, IO_SAFE));
	free(value);
	io_text_free(&io);
}

int main(void)
{
	spelled();
	both();
	quality();
	return tap_done();
}
