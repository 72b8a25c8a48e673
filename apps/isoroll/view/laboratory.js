// What only `view --live` has.
@helper@
@chart@
@triangle@
@lab@
