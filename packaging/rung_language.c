/* SPDX-License-Identifier: MIT
 *
 * rung_language - prints the language file of rung files and lists for GtkSourceView.
 *
 * The build runs it. The words come from the catalogue and the reader. The colour of a word
 * depends on its place, as its meaning does: an element after a bar, an operator at the
 * beginning of a line, a type after a colon.
 */
#include "engine/base/catalog.h"
#include "engine/check/reserved.h"
#include "engine/model/sfc.h"

#include <ctype.h>
#include <stdio.h>
#include <string.h>

static bool is_word(const char *word)
{
	if (!isalpha((unsigned char)word[0]))
		return false;
	for (; *word; word++)
		if (!isalnum((unsigned char)*word) && *word != '_')
			return false;
	return true;
}

/* "LD" or "|LD": the next word of an alternation. */
static void also(bool *first, const char *word, const char *behind)
{
	if (!is_word(word))
		return;
	printf("%s%s%s", *first ? "" : "|", word, behind);
	*first = false;
}

static bool is_type(const char *word)
{
	for (int i = 1; i < IEC_TYPE_COUNT; i++)
		if (strcmp(iec_type_row((enum iec_type)i)->word, word) == 0)
			return true;
	return false;
}

static bool is_constant(const char *word)
{
	return strcmp(word, "TRUE") == 0 || strcmp(word, "FALSE") == 0;
}

static void words_of_elements(void)
{
	bool first = true;

	for (int i = ELEM_WIRE + 1; i < WORD_COUNT; i++)
		also(&first, word_row((enum word)i)->word, "");
}

static void words_of_boxes(bool *first, enum word_kind kind)
{
	for (int i = ELEM_WIRE + 1; i < WORD_COUNT; i++)
		if (word_row((enum word)i)->kind == kind)
			also(first, word_row((enum word)i)->word, "");
}

static void operators(void)
{
	bool first = true;

	for (int i = 0; i < OP_COUNT; i++) {
		const struct op_row *row = op_row((enum op)i);

		also(&first, row->word, row->modifiers & MOD_C ? "C?N?" :
		     row->modifiers & MOD_N ? "N?" : "");
	}
	words_of_boxes(&first, WORD_FN);
}

static void types(void)
{
	bool first = true;

	for (int i = 1; i < IEC_TYPE_COUNT; i++)
		also(&first, iec_type_row((enum iec_type)i)->word, "");
	words_of_boxes(&first, WORD_FB);
}

static void keywords(void)
{
	const char *word;

	for (int i = 0; (word = reserved_word(i)); i++)
		if (is_word(word) && strlen(word) > 1 && !is_type(word) &&
		    !is_constant(word) && op_find(word, strlen(word)) == OP_COUNT)
			printf("      <keyword>%s</keyword>\n", word);
}

/* The words that a line of a chart begins with, and those that end a body behind other
 * words. */
static void words_of_charts(void)
{
	bool first = true;

	for (int i = 0; sfc_word(i); i++)
		also(&first, sfc_word(i)->word, "");
}

static void ends_of_charts(void)
{
	bool first = true;

	for (int i = 0; sfc_word(i); i++)
		if (sfc_word(i)->kind == SFC_WORD_END)
			also(&first, sfc_word(i)->word, "");
}

static void match(const char *id, const char *style, const char *before, void (*words)(void),
		  const char *behind)
{
	printf("    <context id=\"%s\">\n      <match>%s(", id, before);
	words();
	printf(")%s</match>\n      <include>\n"
	       "        <context sub-pattern=\"1\" style-ref=\"%s\"/>\n"
	       "      </include>\n    </context>\n", behind, style);
}

static void head(void)
{
	static const char *const styles[][2] = {
		{ "comment", "comment" }, { "string", "string" }, { "keyword", "keyword" },
		{ "element", "keyword" }, { "operator", "keyword" }, { "type", "type" },
		{ "constant", "special-constant" }, { "number", "number" },
		{ "address", "identifier" },
	};

	printf("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
	       "<language id=\"rung\" name=\"Rungboard\" version=\"2.0\" section=\"Source\">\n"
	       "  <metadata>\n"
	       "    <property name=\"mimetypes\">text/x-rungboard</property>\n"
	       "    <property name=\"globs\">*.rung</property>\n"
	       "    <property name=\"line-comment-start\">//</property>\n"
	       "    <property name=\"block-comment-start\">(*</property>\n"
	       "    <property name=\"block-comment-end\">*)</property>\n"
	       "  </metadata>\n  <styles>\n");
	for (size_t i = 0; i < sizeof(styles) / sizeof(styles[0]); i++)
		printf("    <style id=\"%s\" name=\"%s\" map-to=\"def:%s\"/>\n",
		       styles[i][0], styles[i][0], styles[i][1]);
	printf("  </styles>\n"
	       "  <default-regex-options case-sensitive=\"false\"/>\n  <definitions>\n");
}

static void literals(void)
{
	printf("    <context id=\"block-comment\" style-ref=\"comment\" class=\"comment\">\n"
	       "      <start>\\(\\*</start><end>\\*\\)</end>\n    </context>\n"
	       "    <context id=\"line-comment\" style-ref=\"comment\" class=\"comment\" end-at-line-end=\"true\">\n"
	       "      <start>//</start>\n    </context>\n"
	       "    <context id=\"string\" style-ref=\"string\" class=\"string\" end-at-line-end=\"true\">\n"
	       "      <start>\"</start><end>\"</end>\n    </context>\n"
	       "    <context id=\"text\" style-ref=\"string\" class=\"string\" end-at-line-end=\"true\">\n"
	       "      <start>'</start><end>'</end>\n    </context>\n"
	       "    <context id=\"address\" style-ref=\"address\">\n"
	       "      <match>%%\\w[\\w.]*</match>\n    </context>\n"
	       "    <context id=\"constant\" style-ref=\"constant\">\n"
	       "      <keyword>TRUE</keyword>\n      <keyword>FALSE</keyword>\n"
	       "    </context>\n"
	       "    <context id=\"number\" style-ref=\"number\">\n"
	       "      <match>\\b(\\w+#[\\w.:+-]+|[0-9][0-9_]*(\\.[0-9]+)?(E[+-]?[0-9]+)?)\\b"
	       "</match>\n    </context>\n");
}

int main(void)
{
	static const char *const order[] = {
		"block-comment", "line-comment", "string", "text", "address", "element",
		"type", "chart", "chart-end", "operator", "keyword", "constant", "number",
	};

	head();
	literals();
	match("element", "element", "(?&lt;=\\|)\\s*", words_of_elements, "\\b");
	match("type", "type", ":\\s*", types, "\\b");
	match("chart", "keyword", "^\\s*", words_of_charts, "\\b(?!\\s*[:,])");
	match("chart-end", "keyword", "\\b", ends_of_charts, "\\b");
	match("operator", "operator", "^\\s*(?:\\w+:\\s*)?", operators, "\\b(?!\\s*:)");
	printf("    <context id=\"keyword\" style-ref=\"keyword\">\n");
	keywords();
	printf("    </context>\n    <context id=\"rung\">\n      <include>\n");
	for (size_t i = 0; i < sizeof(order) / sizeof(order[0]); i++)
		printf("        <context ref=\"%s\"/>\n", order[i]);
	printf("      </include>\n    </context>\n  </definitions>\n</language>\n");
	return 0;
}
