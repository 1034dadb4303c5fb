/* SPDX-License-Identifier: MIT
 *
 * test_spelling - every kind of address in both spellings: what is shown reads as the same address.
 */
#include "editor-gtk/kit/spelling.h"
#include "tests/tap.h"

#include <glib.h>
#include <stdio.h>
#include <string.h>

static const char *const names[] = { "IB0", "Q0", "MW4", "mb1" };

static bool is_name(void *context, const char *text, size_t len)
{
	bool is = false;

	(void)context;
	for (size_t i = 0; i < G_N_ELEMENTS(names) && !is; i++)
		is = strlen(names[i]) == len && g_ascii_strncasecmp(names[i], text, len) == 0;
	return is;
}

static const struct spelling_rule iec = { SPELLING_IEC, is_name, NULL };
static const struct spelling_rule siemens = { SPELLING_SIEMENS, is_name, NULL };

static bool is_same(struct iec_addr a, struct iec_addr b)
{
	return a.area == b.area && a.bits == b.bits && a.bit == b.bit && a.byte == b.byte;
}

/* A line with the address in it, there and back. */
static bool comes_back(const char *canonical)
{
	char *line = g_strdup_printf("AND(%s, NOT Start) (* %s *) '%s' > 16#1F", canonical, canonical, canonical);
	char *shown = spelling_text(&siemens, line), *back = spelling_text(&iec, shown);
	const bool good = strcmp(back, line) == 0;

	if (!good)
		printf("# %s\n# %s\n# %s\n", line, shown, back);
	g_free(back);
	g_free(shown);
	g_free(line);
	return good;
}

static int shortened, all;

static bool check_one(struct iec_addr addr)
{
	char shown[32], canonical[32];
	struct iec_addr read, again;

	iec_addr_print(addr, canonical, sizeof(canonical));
	if (iec_addr_parse(canonical, strlen(canonical), &read) != ADDR_OK)
		return true; /* not in that area */
	all++;
	spelling_address(SPELLING_SIEMENS, read, shown, sizeof(shown));
	shortened += *shown != '%';
	if (iec_addr_parse(shown, strlen(shown), &again) == ADDR_OK && is_same(read, again) &&
	    comes_back(canonical))
		return true;
	printf("# %s is shown as %s\n", canonical, shown);
	return false;
}

static void check_all(void)
{
	static const uint8_t widths[] = { 1, 8, 16, 32, 64 };
	bool good = true;

	for (int area = 0; area < AREA_COUNT; area++)
		for (size_t width = 0; width < G_N_ELEMENTS(widths); width++)
			for (uint32_t byte = 0; byte < 300; byte++)
				for (uint8_t bit = 0; bit < (widths[width] == 1 ? 8 : 1); bit++)
					good = area == AREA_NONE ? good : check_one((struct iec_addr){
						.area = (enum iec_area)area, .bits = widths[width], .bit = bit,
						.byte = byte }) && good;
	CHECK_AS(good, "every address is read as it is shown");
	printf("# %d addresses, %d of them without %%\n", all, shortened);
	CHECK_AS(all > 20000 && shortened * 10 > all * 7, "and nearly all are shown in the other spelling");
}

static void check_text(const struct spelling_rule *rule, const char *text, const char *wanted)
{
	char *got = spelling_text(rule, text);

	CHECK_TEXT(got, wanted);
	g_free(got);
}

static void check_texts(void)
{
	check_text(&siemens, "%IX0.0", "I0.0");
	check_text(&siemens, "%QX1.7 := %ix0.3 AND %MX2.1", "Q1.7 := I0.3 AND M2.1");
	check_text(&siemens, "%AIW2 > %VD8", "AIW2 > VD8");
	check_text(&siemens, "%SMX0.1", "SM0.1");
	check_text(&iec, "I0.0 AND SM0.1", "%IX0.0 AND %SMX0.1");
	check_text(&iec, "%I0.3", "%IX0.3");
	/* names come first, in both directions */
	check_text(&iec, "IB0 + MW4 + Q0 + Q0.1 + MB2", "IB0 + MW4 + Q0 + Q0.1 + %MB2");
	check_text(&siemens, "%IB0 + %MW4 + %QX0.1 + %MB1", "%IB0 + %MW4 + %QX0.1 + %MB1");
	/* what is no address */
	check_text(&iec, "Motor.Q0.1 C1 T37 M5 16#B0 Color#IB1 \"IB1\" 'MB3' (* I0.0 *)",
		   "Motor.Q0.1 C1 T37 M5 16#B0 Color#IB1 \"IB1\" 'MB3' (* I0.0 *)");
	check_text(&siemens, "%IX0.9 50 % %IX0.0", "%IX0.9 50 % I0.0");
	check_text(&siemens, "", "");
	/* set by other controllers: without % it would mean that */
	check_text(&siemens, "%SMX0.6", "%SMX0.6");
	check_text(&iec, "SM0.6", "SM0.6");
	/* without a program no name is known: only what has a % is an address */
	check_text(&(struct spelling_rule){ .spelling = SPELLING_IEC }, "I0.0 %I0.1", "I0.0 %IX0.1");
}

int main(void)
{
	check_all();
	check_texts();
	return tap_done();
}
