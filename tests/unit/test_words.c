/* SPDX-License-Identifier: MIT
 *
 * test_words - the word list against the catalogue, and docs/words.md against
 * both.
 *
 * `test_words --print` puts out the page instead; `make words` keeps it so.
 */
#include "engine/base/catalog.h"
#include "engine/view/view.h"
#include "engine/view/words.h"
#include "tests/tap.h"

#include <stdlib.h>

static struct sink_memory memory;

static const char *words(const char *word, bool json, int *count)
{
	struct sink sink = sink_to_memory(&memory);

	sink_memory_free(&memory);
	*count = view_words(word, json, &sink);
	return sink_memory_text(&memory);
}

static void test_all(void)
{
	int count, all = ELEM_PIN /* without the empty cell */ +
		(WORD_COUNT - ELEM_PIN - 1) + OP_COUNT + (IEC_TYPE_COUNT - 1) +
		(AREA_COUNT - 1) + SYS_COUNT;
	const char *text = words(NULL, false, &count);

	CHECK(count == all);
	for (int word = ELEM_EMPTY + 1; word < WORD_COUNT; word++)
		CHECK_AS(strstr(text, word_row((enum word)word)->word) &&
			 strstr(text, word_row((enum word)word)->doc),
			 word_row((enum word)word)->id);
	CHECK(strstr(text, "\nfunction blocks\n") != NULL);
	CHECK(strstr(text, "  NC               |/|  closed while FALSE\n"));
	CHECK(strstr(text, "  INT              2 bytes, -32768 to 32767\n"));
	CHECK(strstr(text, "  SYS_FIRST_SCAN "));
}

static void test_one(void)
{
	int count;

	CHECK_TEXT(words("ton", false, &count),
		   "TON: function block (Timers): on-delay timer\n"
		   "  in  IN   BOOL           starts the delay\n"
		   "  out Q    BOOL           delay elapsed\n"
		   "  in  PT   TIME           preset\n"
		   "  out ET   TIME           time so far, held at PT\n");
	CHECK(count == 1);
	CHECK_TEXT(words("ADD", false, &count),
		   "ADD: function (Math): sum; ENO FALSE on overflow\n"
		   "  2 to 16 inputs, result of their type\n"
		   "  in  IN1  ANY_MAGNITUDE  first\n"
		   "  in  IN2  ANY_MAGNITUDE  next\n");
	CHECK_TEXT(words("R", false, &count),
		   "R: element (Coils): resets while powered\n"
		   "  drawn (R)\n"
		   "  a BOOL it writes, last in its row\n"
		   "R: IL operator: resets the operand if the result is TRUE\n"
		   "  R\n");
	CHECK(count == 2);
	CHECK_TEXT(words("int_to_real", false, &count),
		   "INT_TO_REAL: function (Convert): the same as another type: bits "
		   "of one width stay, others are numbers\n"
		   "  1 input, REAL\n"
		   "  in  IN   INT            value\n");
	CHECK_TEXT(words("and", false, &count),
		   "AND: function (Bits): all inputs, bit by bit\n"
		   "  2 to 16 inputs, result of their type, a BOOL gates the power\n"
		   "  in  IN1  ANY_BIT        first\n"
		   "  in  IN2  ANY_BIT        next\n"
		   "AND: IL operator: result and operand\n"
		   "  AND ANDN AND( ANDN(\n");
	CHECK_TEXT(words("JMP", false, &count) + strlen(
		   "JMP: element (Flow): goes on at a rung's label "
		   "while powered\n"
		   "  drawn >>>\n  a label, last in its row\n"),
		   "JMP: IL operator: goes on at a label; "
		   "C: if TRUE; CN: if FALSE\n"
		   "  JMP JMPC JMPCN\n");
	CHECK_TEXT(words("nonsense", false, &count), "");
	CHECK(count == 0);
	words("", false, &count);
	CHECK(count == 0);
}

static void test_json(void)
{
	int count;

	CHECK_TEXT(words("R_TRIG", true, &count),
		   "[\n {\"kind\": \"function block\", \"word\": \"R_TRIG\", "
		   "\"doc\": \"rising edge detector\", \"family\": \"Edges\", "
		   "\"pins\": [{\"pin\": \"CLK\", \"direction\": \"in\", "
		   "\"type\": \"BOOL\", \"doc\": \"signal\"}, {\"pin\": \"Q\", "
		   "\"direction\": \"out\", \"type\": \"BOOL\", \"doc\": "
		   "\"TRUE for the call in which CLK turned TRUE\"}]}\n]\n");
	CHECK_TEXT(words("nonsense", true, &count), "[\n]\n");
}

static void test_page(const char *path)
{
	struct sink sink = sink_to_memory(&memory);
	static char page[200000];
	FILE *file = fopen(path, "r");
	size_t len = 0;

	sink_memory_free(&memory);
	view_words_markdown(&sink);
	if (file) {
		len = fread(page, 1, sizeof(page) - 1, file);
		fclose(file);
	}
	CHECK_AS(len == memory.len && memcmp(page, memory.text, len) == 0,
		 "docs/words.md is what `make words` writes");
}

static void to_stdout(void *context, const char *text, size_t len)
{
	fwrite(text, 1, len, context);
}

int main(int argc, char **argv)
{
	if (argc > 1 && strcmp(argv[1], "--print") == 0) {
		view_words_markdown(&(struct sink){ to_stdout, stdout });
		return ferror(stdout) != 0;
	}
	test_all();
	test_one();
	test_json();
	test_page("docs/words.md");
	sink_memory_free(&memory);
	return tap_done();
}
