/* SPDX-License-Identifier: MIT
 *
 * assemble - all lists of a project to one code image.
 */
#include "engine/translate/assembler.h"

static bool assemble_section(struct assembler *as, bool watch)
{
	as->text = watch ? &as->watch : &as->code;
	for (int i = 0; i < as->translation->unit_count; i++) {
		struct code_program *entry = &as->entry[i];
		uint32_t first = (uint32_t)as->text->count;

		if (!assemble_unit(as, i, watch))
			return false;
		if (watch) {
			entry->watch = first;
			entry->watch_words = (uint32_t)as->text->count - first;
		} else {
			entry->text = first;
			entry->text_words = (uint32_t)as->text->count - first;
		}
	}
	return true;
}

void *assemble(struct translation *translation, bool watch, size_t *len)
{
	struct assembler *as = arena_alloc(translation->arena, sizeof(*as));

	if (!as)
		return NULL;
	as->translation = translation;
	as->arena = translation->arena;
	as->areas = scope_areas(translation->scope);
	as->entry = arena_alloc(as->arena, ((size_t)translation->unit_count + 1) *
				sizeof(*as->entry));
	if (!as->entry || !layout_make(as) || !assemble_section(as, false))
		return NULL;
	layout_core(as);
	if (watch) {
		layout_power(as);
		if (!assemble_section(as, true))
			return NULL;
	}
	return pack_image(as, len);
}
