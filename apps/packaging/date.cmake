# date.cmake - the date that packages and all files in them bear, so that the same sources make the same bytes: that of
# SOURCE_DATE_EPOCH, or else the day below, to be renewed with the version. CPack reads this file before it begins.
if(NOT DEFINED ENV{SOURCE_DATE_EPOCH})
  set(ENV{SOURCE_DATE_EPOCH} 1795305600) # 22 November 2026
endif()
