/* SPDX-License-Identifier: MIT
 *
 * fuzz_plcopen - reads any bytes as a project in PLCopen XML. What becomes a program is exported and comes
 * back the same.
 *
 * Bytes that begin as no XML are a rung file, which is exported and imported. An input that begins with MADE
 * is a drawing: four bytes an element, its kind, its localId, and two that say what leads to it. So there are
 * circles, numbers that stand twice, connections to nothing, pins that nobody has.
 */
#include "engine/exchange/plcopen/xml_tree.h"
#include "engine/ladder.h"
#include "tests/fuzz/fuzz.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define MADE 0x01
#define ELEMENTS 60
#define ROOM 400 /* of the text of an element */

static const char head[] =
	"<?xml version=\"1.0\" encoding=\"utf-8\"?>\n<project xmlns=\"http://www.plcopen.org/xml/tc6_0201\">\n"
	"<fileHeader companyName=\"C\" productName=\"P\" productVersion=\"1\" creationDateTime=\"2026-01-01T00:00:00\"/>\n"
	"<contentHeader name=\"Made\"/>\n<types><dataTypes/><pous><pou name=\"Main\" pouType=\"program\">\n<interface><localVars>\n";
static const char tail[] = "</pou></pous></types>\n<instances><configurations/></instances>\n</project>\n";

static const struct { const char *type, *first, *second, *out; bool instance; } boxes[] = {
	{ "AND", "IN1", "IN2", "OUT", false }, { "NOT", "IN", "EN", "OUT", false }, { "MOVE", "EN", "IN", "ENO", false },
	{ "TON", "IN", "PT", "Q", true }, { "R_TRIG", "CLK", "EN", "Q", true }, { "SR", "S1", "R", "Q1", true },
	{ "SEL", "G", "IN0", "OUT", false }, { "NOBODY", "A", "B", "C", true },
};
#define BOXES (sizeof(boxes) / sizeof(*boxes))

uint8_t *fuzz_seed(const uint8_t *bytes, size_t len, size_t *out_len)
{
	(void)bytes;
	*out_len = len;
	return NULL;
}

/* ---- made drawings ---- */

static int put_point(char *at, size_t size, int id, int pin)
{
	static const char *const pins[] = { "", " formalParameter=\"Q\"", " formalParameter=\"OUT\"", " formalParameter=\"ENO\"" };

	return id % 13 == 12 ? snprintf(at, size, "<connectionPointIn/>") :
	       snprintf(at, size, "<connectionPointIn><connection refLocalId=\"%d\"%s/></connectionPointIn>", id % 16, pins[pin % 4]);
}

static int put_block(char *at, size_t size, const uint8_t *e)
{
	const int box = e[0] / 8 % (int)BOXES;
	char one[120], two[120];

	put_point(one, sizeof(one), e[2] % 16, e[2] / 16);
	put_point(two, sizeof(two), e[3] % 16, e[3] / 16);
	return snprintf(at, size, "<block localId=\"%d\" typeName=\"%s\"%s%s><inputVariables><variable formalParameter=\"%s\">%s</variable>"
			"<variable formalParameter=\"%s\"%s>%s</variable></inputVariables><inOutVariables/><outputVariables>"
			"<variable formalParameter=\"%s\"/></outputVariables></block>\n", e[1] % 16, boxes[box].type,
			boxes[box].instance ? " instanceName=\"b0\"" : "", e[1] & 64 ? " executionOrderId=\"3\"" : "", boxes[box].first, one,
			boxes[box].second, e[1] & 32 ? " negated=\"true\"" : "", two, boxes[box].out);
}

static int put_element(char *at, size_t size, const uint8_t *e, bool chart)
{
	static const char *const ladder[] = { "leftPowerRail", "contact", "coil", "block", "inVariable", "outVariable", "jump",
					      "continuation" };
	static const char *const steps[] = { "step", "transition", "selectionDivergence", "simultaneousDivergence",
					     "selectionConvergence", "simultaneousConvergence", "jumpStep", "actionBlock" };
	const char *kind = chart && e[3] < 200 ? steps[e[0] % 8] : ladder[e[0] % 8];
	char point[240];
	int len;

	if (!strcmp(kind, "block"))
		return put_block(at, size, e);
	len = put_point(point, sizeof(point), e[2] % 16, e[2] / 16);
	if (e[3] & 1)
		put_point(point + len, sizeof(point) - (size_t)len, e[3] / 2 % 16, 0);
	return snprintf(at, size, "<%s localId=\"%d\" name=\"S%d\" label=\"L\" targetName=\"S%d\"%s><position x=\"%d\" y=\"%d\"/>%s"
			"<variable>v%d</variable><expression>v%d</expression>%s</%s>\n", kind, e[1] % 16, e[1] % 8, e[3] % 8,
			e[1] & 128 ? " negated=\"true\" initialStep=\"true\"" : "", e[3], e[2], strcmp(kind, "leftPowerRail") ? point : "",
			e[1] % 8, e[1] % 8, strcmp(kind, "transition") ? "" : "<condition><inline name=\"\"><ST>v1</ST></inline></condition>",
			kind);
}

/* malloc'ed. */
static char *make(const uint8_t *bytes, size_t len, size_t *out_len)
{
	static const char *const languages[] = { "LD", "FBD", "SFC" };
	const char *language = languages[bytes[1] % 3];
	const size_t room = sizeof(head) + sizeof(tail) + 2000 + ELEMENTS * (size_t)ROOM * 2;
	char *text = malloc(room);
	size_t at;

	if (!text)
		return NULL;
	at = (size_t)snprintf(text, room, "%s", head);
	for (int i = 0; i < 8; i++)
		at += (size_t)snprintf(text + at, room - at, "<variable name=\"v%d\"><type><BOOL/></type></variable>\n", i);
	at += (size_t)snprintf(text + at, room - at, "<variable name=\"b0\"><type><derived name=\"%s\"/></type></variable>\n"
			       "</localVars></interface><body><%s>\n", boxes[3 + bytes[1] / 3 % 3].type, language);
	for (size_t i = 2; i + 4 <= len && i < 2 + 4 * ELEMENTS; i += 4)
		at += (size_t)put_element(text + at, room - at, bytes + i, *language == 'S');
	at += (size_t)snprintf(text + at, room - at, "</%s></body>%s", language, tail);
	*out_len = at;
	return text;
}

/* ---- in and out ---- */

/* What was exported is the same project again. */
static void come_back(struct ladder *ladder)
{
	struct ladder *other = ladder_new();
	struct classic_report report;
	size_t len, text_len, again_len;
	char *xml, *text, *again;

	report_init(&report);
	xml = ladder_export_plcopen(ladder, &len, &report);
	text = ladder_write(ladder, &text_len);
	fuzz_expect(other && xml && text && ladder_take_others(other), "memory");
	fuzz_expect(ladder_load_text(other, "again.xml", xml, len), "what was exported can be read");
	again = ladder_write(other, &again_len);
	fuzz_expect(again && again_len == text_len && !memcmp(text, again, text_len), "it is the same project");
	free(again);
	free(text);
	free(xml);
	report_free(&report);
	ladder_free(other);
}

static bool is_printable(const uint8_t *bytes, size_t len)
{
	for (size_t i = 0; i < len; i++)
		if (bytes[i] < ' ' && bytes[i] != '\n' && bytes[i] != '\t')
			return false;
	return true;
}

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t len)
{
	const bool made = len > 2 && *bytes == MADE, xml = made || (len && (*bytes == '<' || *bytes == 0xef));
	struct ladder *ladder = ladder_new();
	const void *text = bytes;
	char *drawing = NULL;
	size_t size = len;

	if (made)
		text = drawing = make(bytes, len, &size);
	fuzz_expect(ladder && text && ladder_take_others(ladder), "memory");
	if (!ladder_load_text(ladder, xml ? "fuzz.xml" : "fuzz.rung", text, size))
		fuzz_expect(ladder_diags(ladder)->errors > 0, "a refused file has an error");
	else if (!ladder_build(ladder))
		fuzz_expect(ladder_diags(ladder)->errors > 0, "no program, no error");
	else if (xml_is_built() && ladder_project(ladder) && is_printable(text, size))
		come_back(ladder);
	free(drawing);
	ladder_free(ladder);
	return 0;
}
