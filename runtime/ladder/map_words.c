/* SPDX-License-Identifier: MIT
 *
 * map_words - the options of an I/O map, as the rows of hal/map_words.def say.
 */
#include "ladder/map_words.h"

#ifndef RUNGBOARD_SMALL

#include "hal/channel.h"
#include "hal/drivers.h"
#include "hal/map_words.h"

/* An option, and the lines that may have it. */
struct option_said {
	const char *form;
	const char *lines;      /* "WINDOW"; NULL: points with `drivers`, else BUS and SERVE of `kinds` */
	unsigned drivers;       /* ON_…                                        */
	unsigned buses, servers; /* OF_…                                       */
	enum option_for use;
};

static const struct option_said said[] = {
#define CHIP_OPTION(id, text, use, has_value, form, set) { form, NULL, ON_GPIO | ON_SIM, 0, 0, use },
#define VALUE_OPTION(id, text, drivers, use, form, set) { form, NULL, drivers, 0, 0, use },
#define BUS_OPTION(id, text, buses, servers, form, set) { form, NULL, 0, buses, servers, FOR_BOTH },
#define PUBLISH_OPTION(id, text, form, set) { form, "PUBLISH", 0, 0, 0, FOR_BOTH },
#define MODULE_OPTION(id, text, table) { text "=8", "MODULE", 0, 0, 0, FOR_BOTH },
#define TABLE_WORD(id, text, of_bits) { text "=0", "WINDOW MODULE", 0, 0, 0, FOR_BOTH },
#define ACCESS_WORD(text, writable) { text, "WINDOW", 0, 0, 0, FOR_BOTH },
#define DEVICE_OPTION(id, text, form, most, least, member) { form, "DEVICE", 0, 0, 0, FOR_BOTH },
#define DEVICE_ORDER(id, text, form, member) { form, "DEVICE", 0, 0, 0, FOR_BOTH },
#define DEVICE_FLAG(id, text, member) { text, "DEVICE", 0, 0, 0, FOR_BOTH },
#include "hal/map_words.def"
};

static void put_kinds(const struct sink *out, const char *statement, unsigned kinds, bool *any)
{
	static const char *const words[] = { "modbus-rtu", "modbus-tcp", "peer" };

	for (int i = 0; i < 3; i++)
		if (kinds >> i & 1) {
			sink_printf(out, "%s%s %s", *any ? ", " : "", statement, words[i]);
			*any = true;
		}
}

static void put_lines(const struct sink *out, const struct option_said *option)
{
	bool any = option->lines != NULL;

	sink_text(out, any ? option->lines : "");
	for (int i = 0; i < DRIVER_COUNT; i++)
		if (option->drivers >> i & 1) {
			sink_printf(out, "%s%s", any ? " " : "", driver_row((enum driver_id)i)->word);
			any = true;
		}
	put_kinds(out, "BUS", option->buses, &any);
	put_kinds(out, "SERVE", option->servers, &any);
}

void map_words_print(const struct sink *out)
{
	static const char *const use[] = { [FOR_BOTH] = "", [FOR_INPUT] = " (inputs)", [FOR_OUTPUT] = " (outputs)" };

	sink_printf(out, "%-40s %s\n", "option", "lines that may have it");
	for (size_t i = 0; i < sizeof(said) / sizeof(*said); i++) {
		sink_printf(out, "%-40s ", said[i].form);
		put_lines(out, &said[i]);
		sink_printf(out, "%s\n", use[said[i].use]);
	}
}
#endif
