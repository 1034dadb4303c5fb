/* SPDX-License-Identifier: MIT
 *
 * iomap_uses - the inputs and outputs of a program, from its cross reference.
 */
#include "editor-gtk/document/iomap_uses.h"

#include "engine/xref/xref.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define NAME_ROOM (2 * LIMIT_NAME + 16) /* Program.Name                         */

static const char *keep(struct io_uses *uses, const char *text)
{
	const char *kept = arena_copy(&uses->arena, text, strlen(text));

	return kept ? kept : "";
}

static void push(struct io_uses *uses, struct iec_addr addr, const char *name,
		 const char *comment)
{
	struct io_use *use = arena_push(&uses->arena, &uses->use, &uses->count,
					sizeof(*use));

	if (use)
		*use = (struct io_use){ addr, name, comment };
}

/* All elements of an array, up to the end of the area. */
static void push_array(struct io_uses *uses, const struct project *project,
		       const struct var *var, const char *name)
{
	const char *comment = keep(uses, project_text(project, var->comment));
	struct areas areas;
	char text[NAME_ROOM + 32];

	project_areas(project, &areas);
	for (uint32_t i = 0; i < var->array.count; i++) {
		const uint64_t bit = var->at.bit + (uint64_t)i * var->at.bits;
		struct iec_addr addr = var->at;

		if (bit / 8 > LIMIT_AREA)
			return;
		addr.byte += (uint32_t)(bit / 8);
		addr.bit = (uint8_t)(bit % 8);
		if (!areas_have(&areas, addr))
			return;
		snprintf(text, sizeof(text), "%s[%lld]", name,
			 (long long)var->array.low + i);
		push(uses, addr, keep(uses, text), comment);
	}
}

static void take(struct io_uses *uses, struct xref *xref, const struct xref_use *use)
{
	const struct iec_addr addr = use->target.addr;
	const struct var *var = xref_var(xref->project, &use->target);
	char name[NAME_ROOM];

	if (!iec_area_is_io(addr.area) || !addr.bits)
		return;
	if (!var) {
		push(uses, addr, "", "");
		return;
	}
	if (use->kind != XREF_DECLARED)
		return; /* already added by its declaration */
	xref_name(xref->project, &use->target, use, name, sizeof(name));
	if (var->array.count)
		push_array(uses, xref->project, var, name);
	else
		push(uses, addr, keep(uses, name),
		     keep(uses, project_text(xref->project, var->comment)));
}

static int compare_addr(struct iec_addr a, struct iec_addr b)
{
	if (a.area != b.area)
		return a.area < b.area ? -1 : 1;
	if (a.byte != b.byte)
		return a.byte < b.byte ? -1 : 1;
	return a.bit != b.bit ? (int)a.bit - (int)b.bit : (int)a.bits - (int)b.bits;
}

/* At one address, uses with a name come first. */
static int by_address(const void *left, const void *right)
{
	const struct io_use *a = left, *b = right;
	const int order = compare_addr(a->addr, b->addr);

	if (order)
		return order;
	if (!*a->name != !*b->name)
		return *a->name ? -1 : 1;
	return strcmp(a->name, b->name);
}

bool io_uses_make(struct io_uses *out, struct project *project)
{
	struct xref xref;
	int kept = 0;
	bool good;

	memset(out, 0, sizeof(*out));
	arena_init(&out->arena);
	good = xref_make(&xref, project);
	for (int i = 0; good && i < xref.count; i++)
		take(out, &xref, &xref.use[i]);
	xref_free(&xref);
	good = good && !out->arena.failed;
	if (out->count)
		qsort(out->use, (size_t)out->count, sizeof(*out->use), by_address);
	for (int i = 0; i < out->count; i++)
		if (kept == 0 || compare_addr(out->use[kept - 1].addr, out->use[i].addr))
			out->use[kept++] = out->use[i];
	out->count = kept;
	return good;
}

void io_uses_free(struct io_uses *uses)
{
	arena_free(&uses->arena);
	uses->use = NULL;
	uses->count = 0;
}
