/* SPDX-License-Identifier: MIT
 *
 * test_name - spellings of one name, and their hashes and keys.
 *
 * `test_name --keys` prints the key of each line of its input, and whether it is one character
 * that may stand in a name: tests/names.t compares them with another implementation of Unicode.
 */
#include "engine/base/lex.h"
#include "engine/base/name.h"
#include "tests/tap.h"

#include <stdlib.h>

static const struct {
	const char *a, *b;
	bool same;
} pairs[] = {
	{ "Pump", "PUMP", true }, { "Pump", "Pumps", false }, { "", "", true }, { "", "a", false },
	{ "Gr\u00f6\u00dfe", "GR\u00d6\u00dfE", true },
	{ "Gr\u00f6\u00dfe", "Gro\u0308\u00dfe", true },
	{ "GR\u00d6\u1e9eE", "gro\u0308\u00dfe", true },
	{ "Gr\u00f6\u00dfe", "Groesse", false }, { "Gr\u00f6\u00dfe", "Gro\u00dfe", false },
	{ "\u00df", "ss", false },
	{ "\u0417\u0410\u041f\u0423\u0421\u041a", "\u0437\u0430\u043f\u0443\u0441\u043a", true },
	{ "\u0439", "\u0418\u0306", true }, { "\u03a3\u03c3\u03c2", "\u03c3\u03c2\u03a3", true },
	{ "\u212a", "k", true }, { "K", "\u212a", true }, { "\u017f", "S", true },
	{ "\u2126", "\u03c9", true }, { "\u212b", "a\u030a", true },
	{ "\u01d7", "u\u0308\u0301", true }, { "\u01d7", "u\u0301\u0308", false },
	{ "a\u0323\u0307", "A\u0307\u0323", true }, { "a\u0301\u0300", "a\u0300\u0301", false },
	{ "\u1e69", "S\u0307\u0323", true }, { "x\u1e69y", "XS\u0323\u0307Y", true },
	{ "\uac00", "\u1100\u1161", true }, { "\uac01", "\u1100\u1161\u11a8", true },
	{ "\uac01", "\uac00\u11a8", true }, { "\uac00", "\uac01", false },
	{ "\u6e29\u5ea6", "\u6e29\u5ea6", true }, { "\u6e29\u5ea6", "\u6e29", false },
	{ "\U0002f800", "\u4e3d", true }, { "\U00010400", "\U00010428", true },
	{ "\u13a0", "\uab70", true }, { "\u0130", "i\u0307", true }, { "\u0131", "I", false },
	{ "a\xff", "A\xff", true }, { "\xff", "\xfe", false }, { "\xc3", "\u00e3", false },
};

static void same_names(void)
{
	for (size_t i = 0; i < sizeof(pairs) / sizeof(*pairs); i++) {
		const char *a = pairs[i].a, *b = pairs[i].b;
		char left[64], right[64];
		char what[160];

		snprintf(what, sizeof(what), "\"%s\" and \"%s\" are %s name", a, b,
			 pairs[i].same ? "one" : "not one");
		name_key(a, strlen(a), left, sizeof(left));
		name_key(b, strlen(b), right, sizeof(right));
		CHECK_AS(name_equal(a, b) == pairs[i].same && name_equal(b, a) == pairs[i].same &&
			 (strcmp(left, right) == 0) == pairs[i].same &&
			 (!pairs[i].same ||
			  name_hash(a, strlen(a)) == name_hash(b, strlen(b))), what);
	}
}

static void heads(void)
{
	CHECK(name_head("Gr\u00f6\u00dfe", 7, "GRO\u0308\u00dfE.Q", 10) == 8);
	CHECK(name_head("Table", 5, "table[3]", 8) == 5 && name_head("Table", 5, "table", 5) == 5);
	CHECK(name_head("Table", 5, "tables", 6) == 0 && name_head("Table", 5, "tab", 3) == 0);
	CHECK(name_head("A.B", 3, "a.b.C", 5) == 3 && name_head("", 0, "a", 1) == 0);
	CHECK(name_begins("gr\u00d6", 4, "Gro\u0308\u00dfe", 8) && !name_begins("gra", 3, "Gro", 3));
	CHECK(name_begins("", 0, "a", 1) && !name_begins("ab", 2, "a", 1));
	CHECK_AS(name_hash_more(name_hash_more(NAME_HASH, "\u00c4", 2), ".b", 2) ==
		 name_hash_more(NAME_HASH, "a\u0308.B", 5),
		 "the hash of two pieces is that of the whole name");
}

/* Comparing a letter with 100,000 marks takes linear time. */
static void many_marks(void)
{
	const size_t count = 100000;
	char *text = malloc(1 + 2 * count), *other = malloc(1 + 2 * count);

	text[0] = 'a';
	for (size_t i = 0; i < count; i++)
		memcpy(text + 1 + 2 * i, i % 2 ? "\u0323" : "\u0301", 2);
	memcpy(other, text, 1 + 2 * count);
	other[0] = 'A';
	CHECK_AS(name_same(text, 1 + 2 * count, other, 1 + 2 * count), "100,000 marks");
	memcpy(other + 2 * count - 1, "\u0324", 2);
	CHECK_AS(!name_same(text, 1 + 2 * count, other, 1 + 2 * count), "the last one differs");
	free(text);
	free(other);
}

static void keys(void)
{
	char out[16];

	CHECK(name_key("\u00c4b", 3, NULL, 0) == 4);
	CHECK(name_key("\u00c4b", 3, out, sizeof(out)) == 4);
	CHECK_TEXT(out, "a\u0308b");
	name_key("xy\u00c4b", 5, out, 5);
	CHECK_TEXT(out, "xya");
}

static int print_keys(void)
{
	char line[256], key[1024];

	while (fgets(line, sizeof(line), stdin)) {
		const size_t len = strcspn(line, "\n");

		name_key(line, len, key, sizeof(key));
		printf("%s %d\n", key, len > 1 && utf8_length(line, len) == len &&
		       utf8_is_letter(line, len));
	}
	return 0;
}

int main(int argc, char **argv)
{
	if (argc > 1 && strcmp(argv[1], "--keys") == 0)
		return print_keys();
	same_names();
	heads();
	many_marks();
	keys();
	return tap_done();
}
