/* SPDX-License-Identifier: MIT
 *
 * plcopen_address - addresses of tools whose numbers count words where a rung file counts bytes.
 *
 * Beremiz and OpenPLC keep %QW0, %QW1 and %QX0.0 apart, CODESYS counts %QW1 from byte 2 on; here %QW1 begins at
 * byte 1. Addresses stay as they are unless that would make two variables share memory that are apart there, or
 * keep two apart that share it. No address of a bit changes.
 */
#include "engine/exchange/plcopen/plcopen_convert.h"

#include "engine/base/ascii.h"
#include "engine/base/lex.h"

#include <stdlib.h>
#include <string.h>

enum { AREAS = 3, WIDTHS = 4 }; /* I Q M; B W D L                              */

struct used {
	int area, bytes;         /* bytes 0: a bit                              */
	uint32_t number;
	const char *text;
	const struct xml_node *node; /* where it stands first                    */
};

struct finding {
	struct plcopen *c;
	struct used *used;
	int count;
};

/* %QW1; of a bit the byte that it is in. False: the text is no such address. */
static bool parse(const char *text, size_t len, struct used *out)
{
	static const char areas[] = "IQM", widths[] = "BWDL";
	const char *area = len > 2 && *text == '%' ? strchr(areas, ascii_upper(text[1])) : NULL, *width;
	size_t at = 3;

	if (!area || !*area)
		return false;
	width = strchr(widths, ascii_upper(text[2]));
	if (ascii_digit(text[2]))
		at = 2;
	else if (ascii_upper(text[2]) != 'X' && (!width || !*width))
		return false;
	*out = (struct used){ .area = (int)(area - areas), .bytes = at == 3 && width ? 1 << (width - widths) : 0 };
	if (at == len || !ascii_digit(text[at]))
		return false;
	for (; at < len && ascii_digit(text[at]); at++) {
		if (out->number > UINT32_MAX / 100)
			return false;
		out->number = out->number * 10 + (uint32_t)(text[at] - '0');
	}
	return out->bytes ? at == len : at == len || text[at] == '.';
}

static void find_in_text(struct finding *f, const struct xml_node *node, const char *text, size_t len)
{
	struct used one, *added;

	if (!parse(text, len, &one))
		return;
	one.node = node;
	one.text = plc_print(f->c, "%.*s", (int)len, text);
	added = arena_push(f->c->arena, &f->used, &f->count, sizeof(*added));
	if (added)
		*added = one;
}

/* Comments are no part of the program. Nests as deep as the file, which is bounded. */
static void find_in(struct finding *f, const struct xml_node *node)
{
	const char *address = xml_value(node, "address");
	struct lex lex;

	if (xml_is(node, "documentation") || xml_is(node, "comment") || xml_is(node, "fileHeader") ||
	    xml_is(node, "contentHeader"))
		return;
	if (address)
		find_in_text(f, node, address, strlen(address));
	if (node->text && strchr(node->text, '%')) {
		lex_init(&lex, node->text, strlen(node->text));
		while (lex_next(&lex) != TOKEN_END)
			if (lex.token.kind == TOKEN_ADDRESS)
				find_in_text(f, node, lex.token.text, lex.token.len);
	}
	for (const struct xml_node *each = node->first; each; each = each->next)
		find_in(f, each);
}

static int compare_used(const void *a, const void *b)
{
	const struct used *one = a, *two = b;

	return one->area != two->area ? one->area - two->area :
	       one->number != two->number ? (one->number > two->number ? 1 : -1) : one->bytes - two->bytes;
}

/* Do two of the area share a byte, as they stand? */
static bool share(const struct used *used, int count)
{
	const struct used *before = NULL; /* the one that ends last            */
	uint64_t end = 0;

	for (int i = 0; i < count; i++) {
		const uint64_t last = used[i].number + (uint64_t)(used[i].bytes ? used[i].bytes : 1);

		if (before && used[i].number < end && (used[i].bytes != before->bytes || used[i].number != before->number))
			return true;
		if (last > end) {
			end = last;
			before = &used[i];
		}
	}
	return false;
}

static int width_of(int bytes)
{
	return bytes == 1 ? 0 : bytes == 2 ? 1 : bytes == 4 ? 2 : 3;
}

/* Widths that are apart there get a part of the area each, behind that of the narrower ones. */
static void place(struct plcopen *c, const struct used *used, int count, bool apart)
{
	uint64_t end = 0;

	for (int bytes = 0; bytes <= 8; bytes = bytes ? bytes * 2 : 1) {
		uint64_t last = 0;

		for (int i = 0; i < count; i++)
			if (used[i].bytes == bytes)
				last = (used[i].number + 1) * (uint64_t)(bytes ? bytes : 1);
		if (!last)
			continue;
		if (bytes) {
			end = (end + (uint64_t)bytes - 1) / (uint64_t)bytes * (uint64_t)bytes;
			c->address[used->area][width_of(bytes)] = apart ? (int64_t)end : 0;
		}
		end += last;
	}
}

static bool has_widths(const struct used *used, int count)
{
	for (int i = 1; i < count; i++)
		if (used[i].bytes != used[0].bytes)
			return true;
	return false;
}

/* Data of CODESYS; TwinCAT has it too, and counts bytes. */
static bool is_codesys(const struct xml_node *project)
{
	for (const struct xml_node *node = project; node; node = xml_next(node)) {
		const char *name = xml_is(node, "data") ? xml_value(node, "name") : NULL;

		if (name && strstr(name, "3s-software"))
			return true;
	}
	return false;
}

/* Of an export from here, which another tool may have changed. */
static bool is_ours(const struct plcopen *c, const struct xml_node *header)
{
	const char *date = header ? xml_value(header, "creationDateTime") : NULL;

	return c->own || (date && !strcmp(date, "2000-01-01T00:00:00"));
}

static void report_moved(struct plcopen *c, const struct used *used, int count)
{
	for (int i = 0; i < count; i++) {
		const char *to = i && !compare_used(&used[i], &used[i - 1]) ? NULL :
				 plc_moved(c, used[i].text, strlen(used[i].text));

		if (to)
			plc_report(c, REPORT_CHANGED, used[i].node, report_said(c->report,
				   REPORTED("the address %s becomes %s: other tools count it apart, here numbers are those of bytes")),
				   used[i].text, to);
	}
}

static bool is_twincat(const struct xml_node *header)
{
	const char *product = header ? xml_value(header, "productName") : NULL;

	return product && strstr(product, "TwinCAT");
}

bool plc_counts_otherwise(const struct plcopen *c, const struct xml_node *project)
{
	const struct xml_node *header = xml_look(project, "fileHeader");

	return is_ours(c, header) || is_twincat(header) || is_codesys(project);
}

void plc_find_addresses(struct plcopen *c, struct xml_node *project)
{
	const struct xml_node *header = xml_look(project, "fileHeader");
	struct finding f = { .c = c };
	bool codesys;

	for (int i = 0; i < AREAS * WIDTHS; i++)
		c->address[i / WIDTHS][i % WIDTHS] = -1;
	if (is_ours(c, header) || is_twincat(header))
		return;
	codesys = is_codesys(project);
	find_in(&f, project);
	if (f.count)
		qsort(f.used, (size_t)f.count, sizeof(*f.used), compare_used);
	for (int i = 0, count; i < f.count; i += count) {
		for (count = 1; i + count < f.count && f.used[i + count].area == f.used[i].area; count++)
			;
		if (share(f.used + i, count) || (codesys && has_widths(f.used + i, count)))
			place(c, f.used + i, count, !codesys);
	}
	report_moved(c, f.used, f.count);
}

const char *plc_moved(struct plcopen *c, const char *text, size_t len)
{
	struct used one;
	int64_t base;
	uint64_t to;

	if (!parse(text, len, &one) || !one.bytes)
		return NULL;
	base = c->address[one.area][width_of(one.bytes)];
	to = base < 0 ? one.number : (uint64_t)base + (uint64_t)one.number * (uint64_t)one.bytes;
	return to == one.number ? NULL : plc_print(c, "%.3s%llu", text, (unsigned long long)to);
}
