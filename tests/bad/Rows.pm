# SPDX-License-Identifier: MIT
#
# Rows.pm - the words of catalog.def for tests of all words: functions with the types of
# their pins, function blocks with their pins.
package Rows;
use strict;
use warnings;

our %classes = (
	ANY_INT => [qw(SINT INT DINT LINT USINT UINT UDINT ULINT)],
	CLASS_SIGNED => [qw(SINT INT DINT LINT)], CLASS_REAL => [qw(REAL LREAL)],
	CLASS_BITS => [qw(BYTE WORD DWORD LWORD)], CLASS_BOOL => ['BOOL'],
	CLASS_TIME => ['TIME'], CLASS_STRING => ['STRING'],
	CLASS_TOD => ['TIME_OF_DAY'], CLASS_DATE => ['DATE'],
	CLASS_DT => ['DATE_AND_TIME'], ANY_DATE => [qw(TIME_OF_DAY DATE DATE_AND_TIME)],
);
$classes{ANY_NUM} = [map { @{$classes{$_}} } qw(ANY_INT CLASS_REAL)];
$classes{ANY_BIT} = [map { @{$classes{$_}} } qw(CLASS_BOOL CLASS_BITS)];
$classes{ANY_MAGNITUDE} = [@{$classes{ANY_NUM}}, 'TIME'];
$classes{ANY_SIMPLE} = [map { @{$classes{$_}} } qw(ANY_MAGNITUDE ANY_BIT ANY_DATE)];
$classes{ANY_ELEMENTARY} = [@{$classes{ANY_SIMPLE}}, 'STRING'];

# The types in "CLASS_A | CLASS_B", in the order of the catalogue.
sub types_of {
	my ($text) = @_;
	return map { @{$classes{$_} // die "class $_ has no types here\n"} }
		split / \| /, $text;
}

# The rows of functions: word, family, result, most inputs, pins; for each pin its name,
# whether its type is its own, and its types (as a list and a set).
sub functions {
	my ($path) = @_;
	my @rows;
	open my $in, '<', $path or die "$path: $!";
	while (my $line = <$in>) {
		next unless $line =~ /^(?:MORE_)?FN\((\w+),\s*"([^"]*)",\s*"[^"]*",\s*(\w+(?:\([^)]*\))?),\s*(\w+),/ &&
			$1 ne 'id';
		my $row = { word => $1, family => $2, result => $3, most => $4, pins => [] };
		while ($line =~ /FN_(IN|OWN)\((\w+),\s*([\w| ]+?),/g) {
			my ($kind, $name, @list) = ($1, $2, types_of($3));
			push @{$row->{pins}}, { name => $name, own => $kind eq 'OWN',
				list => \@list, takes => { map { $_ => 1 } @list } };
		}
		push @rows, $row;
	}
	return @rows;
}

1;
