/* SPDX-License-Identifier: MIT
 *
 * entry_areas - addresses in use, and those that a new name may get.
 *
 * What is used and what is free the engine knows (xref/address_map.h); which area a new
 * one belongs to is the habit of the project.
 */
#include "editor-gtk/edit/entry_inside.h"

#include "engine/xref/address_map.h"

#include <stdio.h>
#include <string.h>

/* The addresses of a place, or some made for a while. */
struct uses {
	struct xref own;
	struct xref *xref;
};

static bool open_uses(const struct entry_place *place, struct uses *uses)
{
	memset(uses, 0, sizeof(*uses));
	uses->xref = place->xref;
	if (uses->xref)
		return true;
	uses->xref = &uses->own;
	return xref_addresses(&uses->own, place->project);
}

static void close_uses(struct uses *uses)
{
	if (uses->xref == &uses->own)
		xref_free(&uses->own);
}

void entry_each_address(const struct entry_place *place,
			void (*take)(void *context, struct iec_addr addr), void *context)
{
	struct uses uses;

	if (open_uses(place, &uses))
		for (int i = 0; i < uses.xref->count; i++)
			if (uses.xref->use[i].target.what == XREF_ADDRESS)
				take(context, uses.xref->use[i].target.addr);
	close_uses(&uses);
}

static bool is_used(const struct xref *xref, enum iec_area area)
{
	for (int i = 0; i < xref->count; i++)
		if (xref->use[i].target.addr.area == area)
			return true;
	return false;
}

static bool is_declared(const struct entry *entry, struct iec_addr addr)
{
	char text[40];

	iec_addr_print(addr, text, sizeof(text));
	for (int i = 0; i < entry->declares; i++)
		if (!strcmp(entry->declare[i].address, text))
			return true;
	return false;
}

static bool next_free(const struct address_map *map, enum iec_area area, int bits,
		      const struct entry *entry, struct iec_addr *out)
{
	bool found = address_map_next(map, area, bits, 1, NULL, out);

	while (found && is_declared(entry, *out)) {
		const struct iec_addr before = *out;

		found = address_map_next(map, area, bits, 1, &before, out);
	}
	return found;
}

/* Contacts to the inputs, coils to the outputs, or to the markers where a project has
 * those and no outputs. */
static enum iec_area habit(const struct xref *xref, bool output)
{
	if (!output)
		return AREA_I;
	return is_used(xref, AREA_M) && !is_used(xref, AREA_Q) ? AREA_M : AREA_Q;
}

static void add_free(const struct address_map *map, enum iec_area area, int bits,
		     const struct entry *entry, struct entry_new *made)
{
	struct iec_addr addr;

	if (next_free(map, area, bits, entry, &addr))
		iec_addr_print(addr, made->choice[made->choices++], ENTRY_ADDRESS_TEXT);
}

static void add_all(const struct xref *xref, const struct address_map *map, int bits,
		    bool write, const struct entry *entry, struct entry_new *made)
{
	const enum iec_area first = habit(xref, write);

	if (bits > 1)
		made->choice[made->choices++][0] = '\0';
	add_free(map, first, bits, entry, made);
	add_free(map, first == AREA_M ? AREA_Q : AREA_M, bits, entry, made);
	if (bits == 1)
		made->choice[made->choices++][0] = '\0';
}

void entry_proposals(const struct entry_place *place, struct entry *entry,
		     enum iec_type type, bool write)
{
	struct entry_new *made = &entry->declare[entry->declares - 1];
	const struct pou *pou = entry_pou(place);
	const int bits = entry_type_bits(type);
	struct address_map map;
	struct arena arena;
	struct uses uses;

	made->choices = 0;
	if (!pou || pou_has_frame(pou) || bits == 0)
		return;
	arena_init(&arena);
	if (open_uses(place, &uses) && address_map_make(&map, uses.xref, &arena))
		add_all(uses.xref, &map, bits, write, entry, made);
	if (made->choices > 0)
		memcpy(made->address, made->choice[0], sizeof(made->address));
	close_uses(&uses);
	arena_free(&arena);
}

static const struct var *find_on(const struct var_table *table, struct iec_addr addr)
{
	for (int i = 0; i < table->count; i++)
		if (var_lies_on(&table->var[i], addr))
			return &table->var[i];
	return NULL;
}

void entry_shares(const struct entry_place *place, struct iec_addr addr, char *out,
		  size_t size)
{
	const struct project *project = place->project;
	const struct var *var = find_on(&project->globals, addr);

	for (int i = 0; !var && i < project->pou_count; i++)
		var = find_on(&project->pou[i].vars, addr);
	snprintf(out, size, "%s", var ? project_text(project, var->name) : "");
}
