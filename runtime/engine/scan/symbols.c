/* SPDX-License-Identifier: MIT
 *
 * symbols - names of an image: from a name to a location, and through them all.
 *
 * For whoever shows, records or sets variables between scans. The scan itself
 * knows no names.
 */
#include "engine/scan/image.h"

#include <stdio.h>
#include <string.h>

struct location image_locate(const struct image *image, struct iec_addr addr)
{
	struct location at = { .type = iec_addr_type(addr) };
	const struct iec_area_row *row = iec_area_row(addr.area);

	(void)image;
	if (addr.area == AREA_NONE)
		at.type = IEC_NONE;
	else if (addr.bits == 1) {
		at.area = addr.area;
		at.where = addr.byte * 8 + addr.bit;
	} else {
		at.where = row->offset + addr.byte;
	}
	return at;
}

static bool same(const char *a, const char *b, size_t len)
{
	for (size_t i = 0; i < len; i++) {
		unsigned char x = (unsigned char)a[i], y = (unsigned char)b[i];

		x = (unsigned char)(x >= 'a' && x <= 'z' ? x - 32 : x);
		y = (unsigned char)(y >= 'a' && y <= 'z' ? y - 32 : y);
		if (x != y)
			return false;
	}
	return true;
}

static bool is_name(const char *name, const char *text, size_t len)
{
	return strlen(name) == len && same(name, text, len);
}

static struct location symbol_location(const struct code_symbol *symbol)
{
	struct location at = {
		.type = (enum iec_type)symbol->type,
		.area = (enum iec_area)symbol->area,
		.where = symbol->where,
		.constant = symbol->flags & SYMBOL_CONSTANT,
	};
	return at;
}

static struct location pin_location(const struct code_symbol *symbol, int pin)
{
	const struct word_pin *row = &word_row((enum word)symbol->word)->pin[pin];
	struct location at = {
		.type = row->type, .where = symbol->where + row->offset,
	};
	return at;
}

/* The location if @text spells @symbol or a pin of it. */
static struct location match(const struct code_symbol *symbol, const char *name,
			     const char *text, size_t len)
{
	struct location none = { .type = IEC_NONE };
	const struct word_row *row = word_row((enum word)symbol->word);
	size_t own = strlen(name);
	int pin;

	if (symbol->type != IEC_NONE)
		return is_name(name, text, len) ? symbol_location(symbol) : none;
	if (len <= own + 1 || text[own] != '.' || !same(name, text, own))
		return none;
	pin = word_pin_find(row, text + own + 1, len - own - 1);
	return pin < 0 ? none : pin_location(symbol, pin);
}

static struct location find_declared(const struct program *p, const char *text,
				     size_t len)
{
	struct location at = { .type = IEC_NONE };

	for (uint32_t i = 0; i < p->symbol_count && at.type == IEC_NONE; i++) {
		const struct code_symbol *symbol = &p->symbol[i];
		const char *pou = p->string + symbol->pou;
		size_t skip = strlen(pou);

		at = match(symbol, p->string + symbol->name, text, len);
		if (at.type == IEC_NONE && symbol->pou && len > skip + 1 &&
		    text[skip] == '.' && same(pou, text, skip))
			at = match(symbol, p->string + symbol->name,
				   text + skip + 1, len - skip - 1);
	}
	return at;
}

static bool is_system_name(const char *text, size_t len, struct iec_addr *addr)
{
	for (int i = 0; i < SYS_COUNT; i++) {
		const struct sys_row *row = sys_row((enum sys_id)i);

		if (is_name(row->name, text, len))
			return iec_addr_parse(row->address, strlen(row->address),
					      addr) == ADDR_OK;
	}
	return false;
}

struct location image_find(const struct image *image, const char *name,
			   size_t len)
{
	struct location at = find_declared(image->program, name, len);
	struct iec_addr addr;

	if (at.type != IEC_NONE)
		return at;
	if (is_system_name(name, len, &addr) ||
	    iec_addr_parse(name, len, &addr) == ADDR_OK)
		return image_locate(image, addr);
	return at;
}

/* A local is shown by its bare name unless another symbol has it too. */
static bool needs_pou(const struct code_symbol *symbol)
{
	return symbol->pou && symbol->flags & SYMBOL_SHARED;
}

static void print_name(const struct program *p, const struct code_symbol *symbol,
		       const char *pin, struct symbol_cursor *cursor)
{
	bool pou = needs_pou(symbol);

	snprintf(cursor->text, sizeof(cursor->text), "%.255s%s%.255s%s%.40s",
		 pou ? p->string + symbol->pou : "", pou ? "." : "",
		 p->string + symbol->name, pin ? "." : "", pin ? pin : "");
}

bool image_next_symbol(const struct image *image, struct symbol_cursor *cursor,
		       struct symbol *out)
{
	const struct program *p = image->program;

	for (; cursor->index < p->symbol_count; cursor->index++, cursor->pin = 0) {
		const struct code_symbol *symbol = &p->symbol[cursor->index];
		const struct word_row *row = word_row((enum word)symbol->word);

		memset(out, 0, sizeof(*out));
		out->name = cursor->text;
		out->flags = symbol->flags;
		if (symbol->type != IEC_NONE) {
			out->at = symbol_location(symbol);
			print_name(p, symbol, NULL, cursor);
			cursor->index++;
			return true;
		}
		while (cursor->pin < row->pin_count &&
		       row->pin[cursor->pin].dir == PIN_VAR)
			cursor->pin++;
		if (cursor->pin < row->pin_count) {
			const struct word_pin *pin = &row->pin[cursor->pin];

			out->at = pin_location(symbol, (int)cursor->pin);
			out->is_input = pin->dir == PIN_IN;
			print_name(p, symbol, pin->name, cursor);
			cursor->pin++;
			return true;
		}
	}
	return false;
}
