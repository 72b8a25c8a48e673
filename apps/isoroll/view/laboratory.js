// What only `view --live` has.
@helper@
@chart@
@triangle@
@forces@
@judge@
@taken@
@story@
@lab@
