/* SPDX-License-Identifier: MIT
 *
 * service - tables of services and refusals, and fields that several services share.
 */
#include "online/service.h"

#include "engine/scan/resource.h"

#include <string.h>

const char *role_word(enum role role)
{
	static const char *const word[] = {
		[ROLE_NONE] = "none", [ROLE_VIEW] = "view", [ROLE_OPER] = "oper",
		[ROLE_ENG] = "eng", [ROLE_ENG + 1] = "io",
	};

	return word[role];
}

const char *gateway_word(enum gateway_id gateway)
{
	return gateway == GATEWAY_MODBUS ? "modbus" : "peer";
}

const struct service_row *service_row(uint8_t number)
{
	static const struct service_row rows[] = {
#define SERVICE(id, number, word, role, limit_ms) { number, word, ROLE_##role, limit_ms },
#include "online/services.def"
	};

	for (size_t i = 0; i < sizeof(rows) / sizeof(rows[0]); i++)
		if (rows[i].number == number)
			return &rows[i];
	return NULL;
}

enum diag_id refusal_diag(uint16_t number)
{
	switch (number) {
#define REFUSAL(id, number) case number: return DIAG_LINK_##id;
#include "online/refusals.def"
	}
	return DIAG_LINK_REFUSED;
}

const char *mode_word(uint8_t mode)
{
	static const char *const word[] = {
		[STATE_STOP] = "STOP", [STATE_RUN] = "RUN", [STATE_FAULT] = "FAULT",
	};

	return mode < sizeof(word) / sizeof(word[0]) ? word[mode] : "unknown";
}

const char *mode_wish_word(enum mode_wish wish)
{
	return wish == MODE_STOP ? "stop" : wish == MODE_RESET ? "reset" : "run";
}

uint8_t mode_wish_needs(enum mode_wish wish)
{
	return wish == MODE_STOP ? STATE_RUN : wish == MODE_RESET ? STATE_FAULT : STATE_STOP;
}

struct expect wire_expect(struct wire_reader *in)
{
	struct expect expect = { .mode = wire_u8(in) };
	const uint8_t *program = wire_bytes(in, sizeof(expect.program));

	if (program)
		memcpy(expect.program, program, sizeof(expect.program));
	return expect;
}

void wire_put_expect(struct wire_writer *out, const struct expect *expect)
{
	wire_put_u8(out, expect->mode);
	wire_put_bytes(out, expect->program, sizeof(expect->program));
}

struct ref wire_ref(struct wire_reader *in)
{
	struct ref ref = { .kind = (enum ref_kind)wire_u8(in), .name = "" };

	if (ref.kind == REF_PLACE)
		ref.place = wire_u32(in);
	else if (ref.kind == REF_NAME)
		ref.name = wire_text(in, &ref.len);
	else
		in->failed = true;
	return ref;
}

void wire_put_name(struct wire_writer *out, const char *name)
{
	wire_put_u8(out, REF_NAME);
	wire_put_string(out, name);
}

static union iec_value text_value(struct wire_reader *in, struct iec_text *room)
{
	const uint8_t len = wire_u8(in);
	const uint8_t *bytes = wire_bytes(in, len);
	struct iec_string *text = iec_text_init(room, bytes ? len : 0);

	if (bytes)
		memcpy(text->text, bytes, len);
	return (union iec_value){ .s = text };
}

union iec_value wire_value(struct wire_reader *in, enum iec_type type, struct iec_text *room)
{
	uint8_t bytes[8] = { 0 };
	const uint8_t *at;

	if (type == IEC_STRING)
		return text_value(in, room);
	if (type <= IEC_NONE || type >= IEC_TYPE_COUNT) {
		in->failed = true;
		return (union iec_value){ .i = 0 };
	}
	at = wire_bytes(in, iec_type_row(type)->size);
	if (at)
		memcpy(bytes, at, iec_type_row(type)->size);
	if (type == IEC_BOOL && bytes[0] > 1)
		in->failed = true;
	return iec_load(bytes, type);
}

void wire_put_value(struct wire_writer *out, enum iec_type type, union iec_value value)
{
	uint8_t bytes[8] = { 0 };

	if (type == IEC_STRING) {
		wire_put_u8(out, (uint8_t)value.s->length);
		wire_put_bytes(out, value.s->text, value.s->length);
		return;
	}
	iec_store(bytes, type, value);
	wire_put_bytes(out, bytes, iec_type_row(type)->size);
}
