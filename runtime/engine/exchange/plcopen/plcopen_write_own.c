/* SPDX-License-Identifier: MIT
 *
 * plcopen_write_own - the project's own text, as data that other tools leave alone.
 *
 * The format has no subroutines, no EXECUTE, no titles … Whoever imports the file here gets them
 * back, as long as nothing in the XML was changed; a POU that was changed is read from its drawing.
 */
#include "engine/exchange/plcopen/plcopen_digest.h"
#include "engine/exchange/plcopen/plcopen_out.h"

#include "engine/text/text.h"

#include <stdlib.h>
#include <string.h>

/* Some characters cannot stand in XML. */
static bool is_possible(const char *text)
{
	for (; *text; text++)
		if ((unsigned char)*text < ' ' && *text != '\n' && *text != '\t')
			return false;
	return true;
}

static bool is_plain(const struct project *project)
{
	return project->source_count > 0 && project->source[0].plain;
}

static bool has_spaces(const struct project *project)
{
	for (int i = 0; i < project->part_count; i++)
		if (project->part[i].kind == PART_SPACE)
			return true;
	return false;
}

/* What stands behind <![CDATA[. */
static void put_rest(struct out *out, const char *text)
{
	const char *end;

	while ((end = strstr(text, "]]>"))) {
		sink_write(&out->sink, text, (size_t)(end - text) + 2);
		sink_text(&out->sink, "]]><![CDATA[");
		text = end + 2;
	}
	sink_text(&out->sink, text);
	sink_text(&out->sink, "]]></part>\n");
}

static void put_characters(struct out *out, const char *text)
{
	sink_text(&out->sink, "<![CDATA[");
	put_rest(out, text);
}

/* The program, block or function whose actions stand behind it. */
static const char *owner_name(const struct out *out, int part)
{
	const struct pou *pou;

	do
		pou = &out->project->pou[out->project->part[part].index];
	while (pou->kind == POU_ACTION && part-- > 0 && out->project->part[part].kind == PART_POU);
	return pou->kind == POU_ACTION ? "" : plco_id(out, pou->name);
}

static void begin_part(struct out *out, int number)
{
	const struct part *part = &out->project->part[number];
	const struct pou *pou = part->kind == PART_POU ? &out->project->pou[part->index] : NULL;
	const uint64_t digest = pou ? out->digest[part->index] : 0;

	sink_repeat(&out->sink, "  ", out->depth);
	if (!pou || has_spaces(out->project))
		sink_text(&out->sink, "<part>");
	else if (digest)
		sink_printf(&out->sink, "<part pou=\"%s\" digest=\"%016llx\">", plco_id(out, pou->name),
			    (unsigned long long)digest);
	else if (pou->kind == POU_ACTION)
		sink_printf(&out->sink, "<part behind=\"%s\">", owner_name(out, number));
	else
		sink_printf(&out->sink, "<part pou=\"%s\">", plco_id(out, pou->name));
}

/* What other files say stands in the XML itself. */
static bool names_file(const struct out *out, int part)
{
	return part >= 0 && part < out->project->part_count &&
	       (out->project->part[part].kind == PART_INCLUDE || out->project->part[part].kind == PART_USES);
}

/* Hands the text over piece by piece; @number: -1 is the head, that behind the last part the tail. */
static void put_piece(struct out *out, int number, uint32_t *head, const char **all)
{
	const struct sink before = out->sink;
	struct sink_memory memory;

	sink_memory_init(&memory);
	out->sink = sink_to_memory(&memory);
	if (number >= 0 && number < out->project->part_count)
		text_write_part(out->project, number, *head, &out->sink);
	else if (number >= 0)
		text_write_tail(out->project, *head, &out->sink);
	*head = number < 0 ? text_write_head(out->project, &out->sink) : 0;
	out->sink = before;
	if (memory.failed || !is_possible(sink_memory_text(&memory)))
		*all = NULL;
	if (*all && memory.len) {
		if (number < 0 || number == out->project->part_count) {
			sink_repeat(&out->sink, "  ", out->depth);
			sink_text(&out->sink, "<part>");
		} else {
			begin_part(out, number);
		}
		put_characters(out, sink_memory_text(&memory));
	}
	sink_memory_free(&memory);
}

/* Plain IEC text says more than a rung file can: it stands there as a whole, all its files one behind
 * the other. */
static void put_plain(struct out *out, const char **all)
{
	for (int i = 0; i < out->project->source_count && *all; i++) {
		size_t len;
		char *text = text_write_source(out->project, i, &len);

		if (!text || !is_possible(text) || strlen(text) != len)
			*all = NULL;
		if (*all && len) {
			sink_repeat(&out->sink, "  ", out->depth);
			sink_text(&out->sink, i ? "<part><![CDATA[\n" : "<part><![CDATA[");
			put_rest(out, plco_numbers(out, text));
		}
		free(text);
	}
}

static void put_pieces(struct out *out, const char **all)
{
	uint32_t head = 0;

	for (int i = -1; i <= out->project->part_count && *all; i++)
		if (!names_file(out, i))
			put_piece(out, i, &head, all);
}

static void cut(struct out *out, size_t len)
{
	out->text.len = len;
	out->text.text[len] = '\0';
}

static bool any_lost(const struct classic_report *report)
{
	for (int i = 0; i < report->count; i++)
		if (report->line[i].kind == REPORT_LOST)
			return true;
	return false;
}

void plco_own(struct out *out)
{
	const char *from = out->text.failed ? NULL : strstr(out->text.text, "<project"), *all = "";
	const size_t len = out->text.len;
	uint64_t digest;

	if (!from || !out->digest)
		return;
	/* As if it ended here. */
	sink_text(&out->sink, "</project>\n");
	if (out->text.failed)
		return;
	from = strstr(out->text.text, "<project");
	digest = plcopen_digest_text(from, (size_t)(out->text.text + out->text.len - from));
	cut(out, len);
	plco_open(out, "addData");
	plco_open(out, "data name=\"%s\" handleUnknown=\"discard\"", PLCOPEN_OWN);
	plco_open(out, "text xmlns=\"%s\" digest=\"%016llx\"", PLCOPEN_OWN, (unsigned long long)digest);
	if (is_plain(out->project))
		put_plain(out, &all);
	else
		put_pieces(out, &all);
	plco_close(out, "text");
	plco_close(out, "data");
	plco_close(out, "addData");
	if (out->text.failed)
		return;
	if (!all)
		cut(out, len);
	if (!all)
		plco_lost(out, REPORT_LOST, 0, 0, "%s", report_said(out->report,
			  REPORTED("a comment or text has a control character, which XML does not allow: what is lost for other tools does not come back")));
	if (all && any_lost(out->report))
		plco_lost(out, REPORT_TAKEN, 0, 0, "%s", report_said(out->report,
			  REPORTED("an import here brings back what is lost for other tools, as long as they do not change the file")));
}
