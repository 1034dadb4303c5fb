# SPDX-License-Identifier: MIT
#
# Values.pm - difficult values of each type: its limits, 0 and -1, values that are no
# number, times outside a clock.
package Values;
use strict;
use warnings;

# The value for a variable in a script. A value without a literal is given as bits, to a
# variable at the same address: "bits:...".
our %hurt = (
	BOOL => [0, 1], BYTE => [0, 255], WORD => [0, 65535],
	DWORD => [0, 4294967295], LWORD => [0, '18446744073709551615'],
	SINT => [-128, -1, 0, 127], INT => [-32768, -1, 0, 32767],
	DINT => [-2147483648, -1, 0, 2147483647],
	LINT => ['-9223372036854775808', -1, 0, '9223372036854775807'],
	USINT => [0, 1, 255], UINT => [0, 1, 65535], UDINT => [0, 1, 4294967295],
	ULINT => [0, 1, '18446744073709551615'],
	REAL => ['bits:16#7FC00000', 'bits:16#7F800000', '-3.4028234E38', '0.0', '3.4028234E38'],
	LREAL => ['bits:16#7FF8000000000000', 'bits:16#FFF0000000000000',
		'-1.7976931348623157E308', '0.0', '1.7976931348623157E308'],
	TIME => ['bits:16#8000000000000000', 'T#-1ns', 'T#0s', 'bits:16#7FFFFFFFFFFFFFFF'],
	TIME_OF_DAY => ['TOD#00:00:00', 'TOD#23:59:59.999999999', 'bits:16#7FFFFFFFFFFFFFFF',
		'bits:16#FFFFFFFFFFFFFFFF'],
	DATE => ['D#1970-01-01', 'bits:16#8000000000000000', 'bits:16#7FFFFFFFFFFFFFFF'],
	DATE_AND_TIME => ['DT#1970-01-01-00:00:00', 'bits:16#8000000000000000',
		'bits:16#7FFFFFFFFFFFFFFF'],
	STRING => ["''", "'\$00€'", "'12345678'"],
);

# Harmless inputs, and the value of a result before the call, which shows that nothing was
# stored.
our %before = (
	BOOL => 'TRUE', STRING => "'before'", TIME => 'T#7s', TIME_OF_DAY => 'TOD#07:07:07',
	DATE => 'D#2007-07-07', DATE_AND_TIME => 'DT#2007-07-07-07:07:07',
	(map { $_ => '7.0' } qw(REAL LREAL)), (map { $_ => '16#7' } qw(BYTE WORD DWORD LWORD)),
	(map { $_ => '7' } qw(SINT INT DINT LINT USINT UINT UDINT ULINT)),
);

# Constants outside the range of a type, as in cells.
our %beyond = (
	BOOL => 'BOOL#2', BYTE => 'BYTE#256', WORD => 'WORD#16#10000', DWORD => 'DWORD#16#100000000',
	LWORD => 'LWORD#16#10000000000000000', SINT => 'SINT#128', INT => 'INT#-32769',
	DINT => 'DINT#2147483648', LINT => 'LINT#9223372036854775808', USINT => 'USINT#-1',
	UINT => 'UINT#65536', UDINT => 'UDINT#4294967296', ULINT => 'ULINT#18446744073709551616',
	REAL => 'REAL#3.5E38', LREAL => 'LREAL#1.8E308', TIME => 'T#106752d',
	TIME_OF_DAY => 'TOD#24:00:00', DATE => 'D#2262-04-12', DATE_AND_TIME => 'DT#2023-02-29-00:00:00',
	STRING => "'" . 'x' x 256 . "'",
);
our @types = sort keys %hurt;
our %bytes = (BYTE => 1, SINT => 1, USINT => 1, WORD => 2, INT => 2, UINT => 2,
	DWORD => 4, DINT => 4, UDINT => 4, REAL => 4);

# Lists of values, one per pin: all combinations, or if there are too many, the values of
# each pin with the first values of the others, and all limits together.
sub combinations {
	my ($most, @lists) = @_;
	my $all = 1;
	$all *= @$_ for @lists;
	if ($all <= $most) {
		my @made = ([]);
		for my $list (@lists) {
			@made = map { my $one = $_; map { [@$one, $_] } @$list } @made;
		}
		return @made;
	}
	my %seen;
	my @some;
	@lists = map { [@$_ > 2 ? @$_[0, -1] : @$_] } @lists if @lists > 3;
	for my $which (0 .. $#lists) {
		push @some, map { my $value = $_;
			[map { $_ == $which ? $value : $lists[$_][@{$lists[$_]} / 2] } 0 .. $#lists]
		} @{$lists[$which]};
	}
	push @some, [map { $_->[0] } @lists], [map { $_->[-1] } @lists];
	return grep { !$seen{"@$_"}++ } @some;
}

1;
