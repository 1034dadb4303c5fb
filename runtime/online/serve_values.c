/* SPDX-License-Identifier: MIT
 *
 * serve_values - reading, watching, writing and forcing variables.
 */
#include "online/serve.h"

#include <stdio.h>
#include <string.h>

static enum refusal find_place(struct asked *asked, const struct ref *ref, struct location *at)
{
	struct server *server = asked->server;
	const struct program *program = server->setup.program;
	struct iec_addr addr;

	if (ref->kind == REF_PLACE) {
		*at = place_locate(program, ref->place);
		snprintf(asked->detail, sizeof(asked->detail), "place %08x", (unsigned)ref->place);
	} else {
		asked_detail(asked, ref->name, ref->len);
		*at = image_find(&server->mirror, ref->name, ref->len);
	}
	if (at->type == IEC_NONE && ref->kind == REF_NAME && !program->string_bytes &&
	    iec_addr_parse(ref->name, ref->len, &addr) == ADDR_NONE)
		return REFUSAL_NO_NAMES;
	return at->type == IEC_NONE ? REFUSAL_NO_NAME : REFUSAL_NONE;
}

/* Reads the number of variables of a request. */
static enum refusal take_count(struct asked *asked, uint32_t most, uint32_t *count)
{
	*count = wire_u16(&asked->frame.body);
	if (asked->frame.body.failed)
		return REFUSAL_BAD_FRAME;
	if (*count <= most)
		return REFUSAL_NONE;
	snprintf(asked->detail, sizeof(asked->detail), "%u variables; at most %u",
		 (unsigned)*count, (unsigned)most);
	return REFUSAL_TOO_MANY;
}

static enum refusal take_places(struct asked *asked, uint32_t count)
{
	struct server *server = asked->server;

	for (uint32_t i = 0; i < count; i++) {
		const struct ref ref = wire_ref(&asked->frame.body);
		enum refusal refusal;

		if (asked->frame.body.failed)
			return REFUSAL_BAD_FRAME;
		refusal = find_place(asked, &ref, &server->place[i]);
		if (refusal != REFUSAL_NONE)
			return refusal;
	}
	asked->detail[0] = '\0';
	return wire_done(&asked->frame.body) ? REFUSAL_NONE : REFUSAL_BAD_FRAME;
}

/* References and values, as `write` and `force` have them. */
static enum refusal take_items(struct asked *asked, uint32_t count)
{
	struct server *server = asked->server;
	struct wire_reader *in = &asked->frame.body;
	uint32_t texts = 0;

	for (uint32_t i = 0; i < count; i++) {
		const struct ref ref = wire_ref(in);
		const enum iec_type type = (enum iec_type)wire_u8(in);
		struct order_item *item = &server->item[i];
		enum refusal refusal;

		if (type == IEC_STRING && texts == REFS_MOST / 16)
			return REFUSAL_TOO_MANY;
		item->value = wire_value(in, type, &server->text[texts]);
		texts += type == IEC_STRING;
		if (in->failed)
			return REFUSAL_BAD_FRAME;
		refusal = find_place(asked, &ref, &item->at);
		if (refusal == REFUSAL_NONE && item->at.type != type)
			refusal = REFUSAL_TYPE;
		if (refusal != REFUSAL_NONE)
			return refusal;
	}
	return wire_done(in) ? REFUSAL_NONE : REFUSAL_BAD_FRAME;
}

enum refusal serve_read(struct asked *asked)
{
	struct server *server = asked->server;
	struct view look;
	uint32_t count;
	enum refusal refusal = take_count(asked, REFS_MOST, &count);

	if (refusal == REFUSAL_NONE)
		refusal = take_places(asked, count);
	if (refusal == REFUSAL_NONE)
		refusal = serve_look(server, count);
	if (refusal != REFUSAL_NONE)
		return refusal;
	look = server_with_quality(server, asked->session, &server->look);
	asked_begin(asked, 0);
	wire_put_u8(&asked->out, (uint8_t)server->look.state);
	wire_put_u64(&asked->out, server->look.scan);
	wire_put_i64(&asked->out, server->look.now_ns);
	wire_put_u16(&asked->out, (uint16_t)count);
	for (uint32_t i = 0; i < count; i++) {
		const struct location at = server->place[i];

		wire_put_u8(&asked->out, (image_is_forced(&server->mirror, at) ? VALUE_FORCED : 0) |
					 VIEW_QUALITY(&look, server->setup.program, at));
		wire_put_u8(&asked->out, (uint8_t)at.type);
		wire_put_value(&asked->out, at.type, image_get(&server->mirror, at));
	}
	return REFUSAL_NONE;
}

enum refusal serve_publish(struct asked *asked)
{
	struct server *server = asked->server;
	struct wire_reader *in = &asked->frame.body;
	struct publications *all = &asked->session->publications;
	const uint32_t period_us = wire_u32(in);
	const enum publish_what what = (enum publish_what)wire_u8(in);
	struct publish_set *set = NULL;
	enum refusal refusal = REFUSAL_NONE;
	uint32_t count = 0;

	if (in->failed || (what != PUBLISH_VARIABLES && what != PUBLISH_CELLS))
		return REFUSAL_BAD_FRAME;
	if (asked->session->role == ROLE_IO)
		refusal = what == PUBLISH_VARIABLES ? io_check_publish(asked, *in) :
						      asked_refuse_role(asked, ROLE_VIEW);
	if (refusal == REFUSAL_NONE && what == PUBLISH_VARIABLES)
		refusal = take_count(asked, PUBLISH_VALUES, &count);
	if (refusal == REFUSAL_NONE && what == PUBLISH_VARIABLES)
		refusal = take_places(asked, count);
	if (refusal != REFUSAL_NONE)
		return refusal;
	set = publish_new(all, asked->frame.request, period_us);
	if (!set) {
		snprintf(asked->detail, sizeof(asked->detail), "a session can watch %d lists",
			 PUBLISH_SETS);
		return REFUSAL_TOO_MANY;
	}
	for (uint32_t i = 0; i < count && refusal == REFUSAL_NONE; i++)
		if (!publish_add(all, set, server->place[i])) {
			snprintf(asked->detail, sizeof(asked->detail),
				 "a session can watch %u variables", PUBLISH_VALUES);
			refusal = REFUSAL_TOO_MANY;
		}
	if (what == PUBLISH_CELLS) {
		size_t len;
		const char *name = wire_text(in, &len);

		asked_detail(asked, name, len);
		refusal = !wire_done(in) ? REFUSAL_BAD_FRAME :
			  publish_cells(all, set, server->setup.program, name, len);
	}
	set->serial = server->watch.serial + 1;
	if (refusal == REFUSAL_NONE)
		refusal = server_watch_again(server);
	if (refusal != REFUSAL_NONE) {
		publish_drop(all, asked->frame.request);
		return refusal;
	}
	asked_begin(asked, 0);
	wire_put_u32(&asked->out, set->count);
	for (uint32_t i = 0; i < count; i++)
		wire_put_u8(&asked->out, (uint8_t)server->place[i].type);
	return REFUSAL_NONE;
}

enum refusal serve_unpublish(struct asked *asked)
{
	struct wire_reader *in = &asked->frame.body;
	const uint16_t request = wire_u16(in);
	enum refusal refusal;

	if (!wire_done(in))
		return REFUSAL_BAD_FRAME;
	publish_drop(&asked->session->publications, request);
	refusal = server_watch_again(asked->server);
	if (refusal == REFUSAL_NONE)
		asked_begin(asked, 0);
	return refusal;
}

/* "Start=1", "Start=1 and 3 more". */
static void tell_items(struct asked *asked, enum order_kind kind, uint32_t count)
{
	struct server *server = asked->server;
	char value[64] = "", text[80];

	if (!count && kind == ORDER_UNFORCE) {
		asked_tell(asked, EVENT_UNFORCE, "all", "");
		return;
	}
	if (!count)
		return;
	server_name_place(server, server->item[0].at);
	if (kind != ORDER_UNFORCE)
		iec_value_print(server->item[0].at.type, server->item[0].value, value,
				sizeof(value));
	snprintf(text, sizeof(text), count > 1 ? "%.30s%s%.24s and %u more" : "%.40s%s%.36s",
		 server->name, *value ? "=" : "", value, (unsigned)count - 1);
	asked_tell(asked, kind == ORDER_WRITE ? EVENT_WRITE :
			kind == ORDER_FORCE ? EVENT_FORCE : EVENT_UNFORCE, text, "");
}

static bool holds(const struct declared_name *name, struct location at)
{
	const uint32_t behind = at.where - name->at.where;

	if (at.type != name->at.type || at.area != name->at.area || at.where < name->at.where)
		return false;
	if (!name->array.count || !name->stride)
		return behind == 0;
	return behind % name->stride == 0 && behind / name->stride < name->array.count;
}

/* An operator may write what VAR_ACCESS exports with READ_WRITE, by any name of it. */
static enum refusal check_exported(struct asked *asked, uint32_t count)
{
	struct server *server = asked->server;
	struct declared_cursor cursor = { 0 };
	struct declared_name name;

	memset(server->allowed, 0, count);
	while (image_next_access(server->setup.program, &cursor, &name))
		for (uint32_t i = 0; name.flags & SYMBOL_WRITABLE && i < count; i++)
			server->allowed[i] |= holds(&name, server->item[i].at);
	for (uint32_t i = 0; i < count; i++) {
		if (server->allowed[i])
			continue;
		server_name_place(server, server->item[i].at);
		asked_detail(asked, server->name, strlen(server->name));
		return REFUSAL_EXPORTED;
	}
	return REFUSAL_NONE;
}

enum refusal serve_change(struct asked *asked, enum order_kind kind)
{
	struct server *server = asked->server;
	const struct expect expect = wire_expect(&asked->frame.body);
	uint32_t count;
	enum refusal refusal;

	if (!server_can_order(server))
		return REFUSAL_BUSY;
	refusal = take_count(asked, kind == ORDER_WRITE ? REFS_MOST : LIMIT_FORCES, &count);
	if (refusal == REFUSAL_NONE && kind != ORDER_UNFORCE)
		refusal = take_items(asked, count);
	if (refusal == REFUSAL_NONE && kind == ORDER_UNFORCE)
		refusal = take_places(asked, count);
	if (refusal == REFUSAL_NONE && kind == ORDER_WRITE && asked->session->role < ROLE_ENG)
		refusal = check_exported(asked, count);
	if (refusal != REFUSAL_NONE)
		return refusal;
	for (uint32_t i = 0; i < count && kind == ORDER_UNFORCE; i++)
		server->item[i].at = server->place[i];
	asked->detail[0] = '\0';
	server->order = (struct order){
		.kind = kind, .expects = true, .expect = expect,
		.item = server->item, .count = count,
	};
	refusal = asked_finish(asked);
	if (refusal == REFUSAL_NONE)
		tell_items(asked, kind, count);
	return refusal;
}

enum refusal serve_forces(struct asked *asked)
{
	struct server *server = asked->server;
	const enum refusal refusal = server_learn_forces(server);

	if (refusal != REFUSAL_NONE)
		return refusal;
	asked_begin(asked, 0);
	wire_put_u16(&asked->out, (uint16_t)server->mirror.force_count);
	for (int i = 0; i < server->mirror.force_count; i++) {
		const struct force *force = &server->mirror.force[i];

		server_name_place(server, force->at);
		wire_put_u32(&asked->out, place_word(server->setup.program, force->at));
		wire_put_string(&asked->out, server->name);
		wire_put_u8(&asked->out, (uint8_t)force->at.type);
		wire_put_value(&asked->out, force->at.type, force->value);
		wire_put_value(&asked->out, force->at.type, force->aside);
	}
	return REFUSAL_NONE;
}

/* Of a symbol on the wire, beside SYMBOL_CONSTANT and SYMBOL_RETAIN: a name of VAR_ACCESS. */
enum { MARK_EXPORTED = 4, MARK_WRITABLE = 8 };

static uint8_t symbol_marks(uint32_t flags)
{
	return (uint8_t)((flags & (SYMBOL_CONSTANT | SYMBOL_RETAIN)) |
			 (flags & SYMBOL_EXPORTED ? MARK_EXPORTED : 0) |
			 (flags & SYMBOL_WRITABLE ? MARK_WRITABLE : 0));
}

/* The next variable of a session; behind the last one the names of VAR_ACCESS. */
static bool next_symbol(struct session *session, const struct image *image,
			struct symbol *symbol)
{
	if (image_next_symbol(image, &session->symbols, symbol))
		return true;
	if (session->symbols.access)
		return false;
	session->symbols = (struct symbol_cursor){ .access = true };
	return image_next_symbol(image, &session->symbols, symbol);
}

/* Moves the session's cursor to symbol @from. */
static bool seek_symbol(struct asked *asked, uint32_t from, struct symbol *symbol)
{
	struct session *session = asked->session;
	const struct image *image = &asked->server->mirror;

	if (from < session->symbol || from == 0) {
		session->symbols = (struct symbol_cursor){ .whole = false };
		session->symbol = 0;
	}
	for (; session->symbol < from; session->symbol++)
		if (!next_symbol(session, image, symbol))
			return false;
	return true;
}

/* The rest goes with the next page. */
enum refusal serve_symbols(struct asked *asked)
{
	struct session *session = asked->session;
	const struct server *server = asked->server;
	const struct program *program = server->setup.program;
	struct wire_writer *out = &asked->out;
	const uint32_t from = wire_u32(&asked->frame.body);
	struct symbol symbol;
	uint16_t count = 0;
	uint8_t *head;
	bool more = true;

	if (!wire_done(&asked->frame.body))
		return REFUSAL_BAD_FRAME;
	if (!program->string_bytes)
		return REFUSAL_NO_NAMES;
	asked_begin(asked, 0);
	head = out->at;
	wire_put_u32(out, 0);
	wire_put_u16(out, 0);
	more = seek_symbol(asked, from, &symbol);
	while (more && (size_t)(out->end - out->at) > SYMBOL_BYTES && count < UINT16_MAX) {
		char address[40] = "";

		more = next_symbol(session, &server->mirror, &symbol);
		if (!more)
			break;
		session->symbol++;
		if (symbol.flags & SYMBOL_HIDDEN)
			continue;
		place_address(program, symbol.at, address, sizeof(address));
		wire_put_string(out, symbol.name);
		wire_put_u8(out, (uint8_t)symbol.at.type);
		wire_put_u8(out, symbol_marks(symbol.flags));
		wire_put_u32(out, place_word(program, symbol.at));
		wire_put_string(out, address);
		count++;
	}
	{
		struct wire_writer fill = wire_write(head, 6);

		wire_put_u32(&fill, more ? session->symbol : 0);
		wire_put_u16(&fill, count);
	}
	return REFUSAL_NONE;
}
