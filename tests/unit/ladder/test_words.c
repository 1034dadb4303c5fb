/* SPDX-License-Identifier: MIT
 *
 * test_words - compares the word list with the catalogue, and docs/words.md with both.
 *
 * Builds every example and scans it without a fault, also those of words without a row.
 * tests/docs.t does the same with the page, with the public commands.
 *
 * `test_words --print` prints the page instead; `make words` writes it.
 */
#include "engine/base/catalog.h"
#include "ladder/words.h"
#include "tests/tap.h"
#include "tests/unit/rig.h"

#include <stdlib.h>
#include <string.h>
#include <strings.h>

static struct sink_memory memory;

static const char *words(const char *word, bool json, int *count)
{
	struct sink sink = sink_to_memory(&memory);

	sink_memory_free(&memory);
	*count = words_list(word, json, &sink);
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
			 strstr(text, explain_word(word_row((enum word)word))),
			 explain_id(word_row((enum word)word)));
	CHECK(strstr(text, "\nfunction blocks\n") != NULL);
	CHECK(strstr(text, "  NC               |/|  closed while FALSE\n"));
	CHECK(strstr(text, "  INT              2 bytes, -32768 to 32767\n"));
	CHECK(strstr(text, "  SYS_FIRST_SCAN "));
}

/* The lines before the source, of all entries of a word. */
static const char *facts(const char *word, int *count)
{
	static char out[4000];
	char *text = strdup(words(word, false, count)), *rest;
	size_t len = strlen(word), end = 0;
	bool shown = true;

	for (char *line = strtok_r(text, "\n", &rest); line;
	     line = strtok_r(NULL, "\n", &rest)) {
		if (strncmp(line, "  source: ", 10) == 0)
			shown = false;
		else if (strncasecmp(line, word, len) == 0 && line[len] == ':')
			shown = true;
		if (shown && end < sizeof(out))
			end += (size_t)snprintf(out + end, sizeof(out) - end, "%s\n",
						line);
	}
	free(text);
	return out;
}

static void test_one(void)
{
	int count;

	CHECK_TEXT(facts("ton", &count),
		   "TON: function block (Timers): on-delay timer\n"
		   "  in  IN   BOOL           starts the delay\n"
		   "  out Q    BOOL           delay elapsed\n"
		   "  in  PT   TIME           preset\n"
		   "  out ET   TIME           time so far, held at PT\n");
	CHECK(count == 1);
	CHECK_TEXT(facts("ADD", &count),
		   "ADD: function (Math): sum; ENO FALSE on overflow\n"
		   "  2 to 16 inputs, result of their type\n"
		   "  in  IN1  ANY_MAGNITUDE  first\n"
		   "  in  IN2  ANY_MAGNITUDE  next\n");
	CHECK_TEXT(facts("R", &count),
		   "R: element (Coils): resets while powered\n"
		   "  symbol (R)\n"
		   "  a BOOL it writes, only outputs behind it\n"
		   "R: IL operator: resets the operand if the result is TRUE\n"
		   "  R\n");
	CHECK(count == 2);
	CHECK_TEXT(facts("int_to_real", &count),
		   "INT_TO_REAL: function (Convert): the same as another type: bits "
		   "of one width stay, others are numbers\n"
		   "  1 input, REAL\n"
		   "  in  IN   INT            value\n");
	CHECK_TEXT(facts("and", &count),
		   "AND: function (Bits): all inputs, bit by bit\n"
		   "  2 to 16 inputs, result of their type, a BOOL gates the power\n"
		   "  in  IN1  ANY_BIT        first\n"
		   "  in  IN2  ANY_BIT        next\n"
		   "AND: IL operator: result and operand\n"
		   "  AND ANDN AND( ANDN(\n");
	CHECK_TEXT(facts("JMP", &count) + strlen(
		   "JMP: element (Flow): jumps to the label of a rung "
		   "while powered\n"
		   "  symbol >>\n  a label, last in its row\n"),
		   "JMP: IL operator: jumps to a label; "
		   "C: if TRUE; CN: if FALSE\n"
		   "  JMP JMPC JMPCN\n");
	CHECK_TEXT(words("nonsense", false, &count), "");
	CHECK(count == 0);
	words("", false, &count);
	CHECK(count == 0);
}

static void begins(const char *text, const char *with)
{
	if (!CHECK_AS(strncmp(text, with, strlen(with)) == 0, "the JSON begins as expected"))
		printf("# got: %s\n", text);
}

static void test_json(void)
{
	int count;

	begins(words("R_TRIG", true, &count),
		   "[\n {\"kind\": \"function block\", \"word\": \"R_TRIG\", "
		   "\"doc\": \"rising edge detector\", \"family\": \"Edges\", "
		   "\"pins\": [{\"pin\": \"CLK\", \"direction\": \"in\", "
		   "\"type\": \"BOOL\", \"doc\": \"signal\"}, {\"pin\": \"Q\", "
		   "\"direction\": \"out\", \"type\": \"BOOL\", \"doc\": "
		   "\"TRUE for the call in which CLK turned TRUE\"}], "
		   "\"source\": \"IEC 61131-3 table 44\", "
		   "\"section\": \"language.md#Function blocks\", "
		   "\"example\": \"RUNGBOARD 1\\n\\nVAR\\n"
		   "  Input  AT %IX0.0 : BOOL;\\n"
		   "  Output AT %QX0.0 : BOOL;\\n"
		   "  Box    : R_TRIG;\\nEND_VAR\\n\\nPROGRAM Main LD\\nRUNG\\n"
		   "  | NO Input | R_TRIG Box | COIL Output |\\nEND_PROGRAM\\n\", "
		   "\"picture\": \"PROGRAM Main\\n\\n");
	CHECK_TEXT(words("nonsense", true, &count), "[\n]\n");
}

/* Builds and scans one example. */
static void run_example(const char *word, const char *text)
{
	struct rig rig;
	const char *body = strchr(text, '\n');

	if (!CHECK_AS(body != NULL, word) || !rig_open(&rig, body + 1, false)) {
		printf("# the example of %s\n", word);
		if (body)
			rig_close(&rig);
		return;
	}
	if (strstr(text, "Input  AT"))
		rig_force(&rig, "Input", 1);
	for (int i = 0; i < 3; i++)
		rig_scan(&rig);
	CHECK_AS(rig.resource.scans > 0 && rig.resource.fault == FAULT_NONE,
		 word);
	CHECK_AS(rig.resource.vm.errors == 0, word);
	rig_close(&rig);
}

static void test_example(const struct words_entry *entry, enum words_form form)
{
	struct sink_memory example;
	struct sink sink = sink_to_memory(&example);

	sink_memory_init(&example);
	if (words_example(entry, form, &sink) && form != WORDS_AS_PICTURE)
		run_example(entry->word, sink_memory_text(&example));
	sink_memory_free(&example);
}

/* The page has the section that the row names. */
static void test_section(const struct words_entry *entry)
{
	static char page[100000];
	const char *section = words_source(entry)->section;
	const char *title = strchr(section, '#');
	char path[60], line[80];
	FILE *file;
	size_t len = 0;

	snprintf(path, sizeof(path), "docs/%.*s", (int)(title - section), section);
	snprintf(line, sizeof(line), "# %s\n", title + 1);
	file = fopen(path, "r");
	if (file) {
		len = fread(page, 1, sizeof(page) - 1, file);
		fclose(file);
	}
	page[len] = '\0';
	CHECK_AS(strstr(page, line) != NULL, entry->word);
}

static void test_examples(void)
{
	struct words_entry entry;

	for (int i = 0; words_at(i, &entry); i++) {
		struct sink_memory one;
		struct sink sink = sink_to_memory(&one);
		enum words_form form = entry.kind == WORDS_OPERATOR ?
				       WORDS_AS_LIST : WORDS_AS_FILE;

		sink_memory_init(&one);
		CHECK_AS(words_example(&entry, form, &sink), entry.word);
		sink_memory_free(&one);
		test_example(&entry, WORDS_AS_FILE);
		test_example(&entry, WORDS_AS_LIST);
		test_section(&entry);
	}
}

/* Words without a row: the text between "example:" and "drawn:". */
static void test_made_examples(void)
{
	static const char *const made[] = {
		"INT_TO_REAL", "REAL_TO_STRING", "STRING_TO_INT", "TO_DINT",
		"STRING_TO_TIME", "STRING_TO_DATE", "STRING_TO_REAL",
		"REAL_TRUNC_INT", "TRUNC_DINT", "WORD_BCD_TO_UINT",
		"UINT_TO_BCD_WORD", "BOOL_TO_INT", "DATE_AND_TIME_TO_DATE",
		"LTIME_TO_LINT", "TON_TIME", "CTU_INT",
	};

	for (size_t i = 0; i < sizeof(made) / sizeof(made[0]); i++) {
		int count;
		char *text = strdup(words(made[i], false, &count));
		char *from = strstr(text, "\nRUNGBOARD"), *end = strstr(text, "\ndrawn:");

		if (CHECK_AS(from && end, made[i])) {
			*end = '\0';
			run_example(made[i], from + 1);
		}
		free(text);
	}
}

static void test_page(const char *path)
{
	struct sink sink = sink_to_memory(&memory);
	static char page[400000];
	FILE *file = fopen(path, "r");
	size_t len = 0;

	sink_memory_free(&memory);
	words_markdown(&sink);
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
		words_markdown(&(struct sink){ .write = to_stdout, .context = stdout });
		return ferror(stdout) != 0;
	}
	test_all();
	test_one();
	test_json();
	test_examples();
	test_made_examples();
	test_page("docs/words.md");
	sink_memory_free(&memory);
	return tap_done();
}
